#pragma once

#include "ga/run/context.hpp"

#include <algorithm>

namespace ga {

/// The best fitness of those that are scored under one objective and have not failed, as the objective states
/// it; none where there are none.
template <class G>
std::optional<double> best_value(const Population<G>& population) {
    const Fitness* best = nullptr;
    for (const auto& individual : population)
        if (const Fitness& f = individual.fitness; f.known() && !f.has_failed() && !f.several())
            if (!best || (best->known(f.objective_name()) && better(f, *best)))
                best = &f;
    return best ? std::optional(best->value()) : std::nullopt;
}

/// A population in four numbers.
struct Summary {
    std::size_t individuals = 0;  ///< scored or not
    std::optional<double> best;   ///< fitness under one objective among the scored that have not failed; none
                                  ///< where there are none
    std::optional<double> median; ///< of the same
    double diversity = 0;         ///< share of different genomes, in (0, 1]
};

/// Of a population under the objective it was last scored by.
template <Problem P>
Summary summary(const P& problem, const PopulationOf<P>& population) {
    Summary summary;
    summary.individuals = population.size();
    std::vector<double> values;
    Table<bool> different;
    for (const auto& individual : population) {
        different.at(identify(problem, individual.genome)) = true;
        if (individual.fitness.known() && !individual.fitness.has_failed() && !individual.fitness.several())
            values.push_back(individual.value());
    }
    summary.diversity = population.empty()
                            ? 0
                            : static_cast<double>(different.size()) / static_cast<double>(population.size());
    if (values.empty())
        return summary;
    std::sort(values.begin(), values.end());
    summary.best = best_value(population);
    summary.median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
    return summary;
}

} // namespace ga
