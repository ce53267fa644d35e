#pragma once

#include "domain/database/store.hpp"

#include <atomic>
#include <functional>

namespace rough {

/// Genomes to be computed, and what becomes of them.
struct Orders {
    std::uint64_t count = 0;                            ///< how many are missing
    std::function<std::optional<std::uint64_t>()> next; ///< a genome's number; nothing after the last
    /// Its response, in any order; from the thread that asked.
    std::function<void(std::uint64_t genome, Response response)> take;
    std::function<bool()> ended; ///< no more are wanted
};

/// Computes the responses of a set-up's genomes by response_for, here or elsewhere.
using Computing = std::function<void(const DatabaseSetup& setup, const Orders& orders)>;

/// On so many threads, 0 for all, so many genomes at a time.
Computing on_threads(int threads, std::uint64_t at_a_time = 250);

/// How far a build goes and how it works.
struct BuildOptions {
    std::uint64_t genomes = 100'000; ///< how many the database is to hold
    std::uint64_t first = 0;         ///< from this number on: a part of a law's genomes
    std::uint64_t batch = 250;       ///< stored at a time: what a kill may cost
    int threads = 0;                 ///< 0: all
    Computing computing = {};        ///< in place of on_threads(threads, batch)
    /// told after every batch how many genomes are stored; the build ends when it returns false
    std::function<bool(std::uint64_t stored)> go_on = [](std::uint64_t) { return true; };
    /// where it becomes true, the build ends without the batches that it is at
    const std::atomic<bool>* stop = nullptr;
};

/// The response of a genome of the set-up's law; NaN in place of one that does not converge.
Response response_for(const DatabaseSetup& setup, std::uint64_t genome);

/// Computes and stores the missing genomes of the store's law, batch by batch. A genome's numbers depend on
/// the set-up and its index alone, so builds may be stopped, killed, resumed and shared. Batches under way, a
/// few for each who computes, are all that is held in memory. Throws InputError when the set-up has no
/// solution.
void build(GenomeStore& store, const BuildOptions& options);

/// Puts the genomes of several databases of one set-up, law and version into a new file, which appears under
/// its name when it is whole; one that is there is replaced. Of a genome in several of them the first copy is
/// taken. Gives how many genomes it holds. Throws InputError on databases that differ, on a genome that is
/// not its law's, and on one that was altered.
std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

} // namespace rough
