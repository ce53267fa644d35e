#pragma once

#include "domain/database/store.hpp"

#include <atomic>

namespace rough {

/// The genomes that a build requests, and what it does with their responses.
struct Orders {
    std::uint64_t count = 0;                            ///< how many genomes are missing
    std::function<std::optional<std::uint64_t>()> next; ///< a genome's number; nothing after the last one
    /// Accepts a genome's response, in any order. One thread at a time may call any of these functions.
    std::function<void(std::uint64_t genome, Response response)> take;
    std::function<bool()> ended; ///< no more responses are wanted
};

/// Computes the responses of a set-up's genomes by response_for, here or on other machines.
using Computing = std::function<void(const DatabaseSetup& setup, const Orders& orders)>;

/// Computes on `threads` threads (0: all).
Computing on_threads(int threads);

/// Options of a build.
struct BuildOptions {
    std::uint64_t genomes = 100'000; ///< number of genomes to hold
    std::uint64_t first = 0;         ///< number of the first one, for a part of a distribution's genomes
    std::uint64_t batch = 250;       ///< genomes stored together; a kill loses at most these
    int threads = 0;                 ///< 0: all
    Computing computing = {};        ///< in place of on_threads(threads)
    /// Called after every batch with the number of stored genomes. The build ends when it returns false.
    std::function<bool(std::uint64_t stored)> go_on = [](std::uint64_t) { return true; };
    /// When it becomes true, the build ends and drops unfinished batches.
    const std::atomic<bool>* stop = nullptr;
};

/// The response of a genome of the set-up's distribution; NaN if the solution does not converge.
Response response_for(const DatabaseSetup& setup, std::uint64_t genome);

/// Computes and stores the missing genomes of the store, batch by batch. A genome's numbers depend only on
/// the set-up and its index, so builds may be stopped, killed, resumed and shared. Only unfinished batches
/// are held in memory, a few per thread or machine. Throws InputError if the set-up has no solution.
void build(GenomeStore& store, const BuildOptions& options);

/// Puts the genomes of several databases of one set-up, distribution and version into a new file. The file
/// gets its name when it is complete, and replaces an older file. If several databases contain the genome,
/// the first copy is taken. Returns the number of genomes. Throws InputError on databases that differ, on
/// genomes that are not those of their distribution, and on altered numbers.
std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

} // namespace rough
