#pragma once

#include "domain/design/problem.hpp"
#include "domain/paper/phases.hpp"

namespace rough {

/// The genome's length scales that by themselves follow a goal: the curve of one alone, in the genome's own
/// amplitude and loaded as far as the goal goes, correlates with the goal's at its points by more than the
/// threshold (Pearson). The best correlated where none does, all where none has an answer. After Cinat, Paggi
/// and Gnecco (2019), who keep such chromosomes for each of two targets.
Genome reduced_to_goal(const DesignSetup& setup, const Genome& genome, std::size_t goal,
                       double threshold = 0.95);

} // namespace rough
