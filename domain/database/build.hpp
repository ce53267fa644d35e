#pragma once

#include "domain/database/store.hpp"

#include <atomic>

namespace rough {

/// The genomes that a build requests. One thread at a time may call any of these functions.
struct Orders {
    std::uint64_t count = 0;                            ///< number of genomes that are missing
    std::function<std::optional<std::uint64_t>()> next; ///< next genome's number; nothing after the last one
    /// Takes the response of a genome; the order does not matter.
    std::function<void(std::uint64_t genome, Response response)> take;
    std::function<bool()> ended; ///< whether the build has ended and ignores further responses
};

/// Computes the responses of a set-up's genomes by response_for(), in this process or on other machines.
using Computing = std::function<void(const DatabaseSetup& setup, const Orders& orders)>;

/// Options of a build.
struct BuildOptions {
    std::uint64_t genomes = 100'000; ///< number of genomes to store
    std::uint64_t first = 0;         ///< number of the first genome, for a part of a distribution
    std::uint64_t batch = 250;       ///< number of genomes stored together; a kill loses at most one batch
    int threads = 0;                 ///< number of threads; 0: all
    Computing computing = {};        ///< computes the responses; empty: the threads of this process do
    /// Called after every batch with the number of stored genomes. The build ends if it returns false.
    std::function<bool(std::uint64_t stored)> go_on = [](std::uint64_t) { return true; };
    /// If it becomes true, the build ends and drops unfinished batches.
    const std::atomic<bool>* stop = nullptr;
};

/// The response of a genome of the set-up's distribution; NaN if the solution does not converge.
Response response_for(const DatabaseSetup& setup, std::uint64_t genome);

/// Computes and stores the missing genomes of the store, batch by batch. Builds may be stopped, killed,
/// resumed and shared, with equal results. Throws InputError if the set-up has no solution.
void build(GenomeStore& store, const BuildOptions& options);

/// Puts the genomes of several databases of one set-up, distribution and version into a new file. A complete
/// file replaces an older one. Returns the number of different genomes. Throws InputError if the databases
/// have different set-ups, distributions or versions, and if one was altered.
std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

} // namespace rough
