#pragma once

#include "domain/paper/dominance.hpp"
#include "domain/problem/setup.hpp"

namespace rough {

/// The genome's length scales that by themselves follow a target: the curve of one alone, in the genome's own
/// amplitude and loaded as far as the target goes, correlates with the target's at its points by more than
/// the threshold (Pearson). The best correlated where none does, all where none has an answer. After Cinat,
/// Paggi and Gnecco (2019), who keep such chromosomes for each of two targets.
Genome reduced_to_target(const DesignSetup& setup, const Genome& genome, std::size_t target,
                         double threshold = dominance_threshold);

} // namespace rough
