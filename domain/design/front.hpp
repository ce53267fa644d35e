#pragma once

#include "domain/problem/problem.hpp"
#include "ga/problem/individual.hpp"

namespace rough {

/// A genome that no other found is better than in every target.
struct Compromise {
    Genome genome;                          ///< amplitude final
    std::vector<double> similarity;         ///< each target's, on the set-up's grid
    std::vector<double> similarity_refined; ///< the same on a grid four times finer
};

/// The genomes on the front of a population that `pareto` ranked; nothing of another.
std::vector<Genome> genomes_on_front(const ga::Population<Genome>& population);

/// Those of the genomes that are within the limits and that no other is better than, by the first target's
/// similarity, the best last; at most `most`, spread evenly with both ends among them.
std::vector<Compromise> compromises(const DesignSetup& setup, const std::vector<Genome>& genomes,
                                    std::size_t most, int threads);

} // namespace rough
