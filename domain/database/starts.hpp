#pragma once

#include "domain/database/store.hpp"
#include "domain/problem/problem.hpp"

namespace rough {

/// The stored genomes nearest to a design's targets, best first and in the amplitude that meets them: where
/// refinement begins when an answer is wanted at once. At most `count`. Throws InputError naming the first
/// difference where the database belongs to another model.
std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                  int threads = 0);

} // namespace rough
