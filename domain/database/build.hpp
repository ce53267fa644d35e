#pragma once

#include "domain/database/store.hpp"

#include <atomic>
#include <functional>

namespace rough {

/// How far a build goes and how it works.
struct BuildOptions {
    std::uint64_t genomes = 100'000; ///< how many the database is to hold
    std::uint64_t batch = 250;       ///< stored at a time: what a kill may cost
    int threads = 0;                 ///< 0: all
    /// told after every batch how many genomes are stored; the build ends when it returns false
    std::function<bool(std::uint64_t stored)> go_on = [](std::uint64_t) { return true; };
    /// where it becomes true, the build ends without the batch that it is at
    const std::atomic<bool>* stop = nullptr;
};

/// Computes and stores the missing genomes of the store's law, batch by batch. A genome's numbers depend on
/// the set-up and its index alone, so builds may be stopped, killed, resumed and shared. A genome whose curve
/// does not converge is kept with NaN for its response. Throws InputError when the set-up has no solution.
void build(GenomeStore& store, const BuildOptions& options);

} // namespace rough
