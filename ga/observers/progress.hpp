#pragma once

#include "ga/run/context.hpp"

#include <cstdio>

namespace ga {

/// The best fitness of the individuals that are scored under one objective and have not failed; empty without
/// such an individual.
template <class G>
std::optional<double> best_value(const Population<G>& population) {
    const Fitness* best = nullptr;
    for (const auto& individual : population)
        if (const Fitness& f = individual.fitness; f.has_value())
            if (!best || (best->known(f.objective_name()) && better(f, *best))) best = &f;
    return best ? std::optional(best->value()) : std::nullopt;
}

/// Four numbers that describe a population.
struct Summary {
    std::size_t individuals = 0;  ///< number of individuals, scored or not
    std::optional<double> best;   ///< best fitness (see best_value)
    std::optional<double> median; ///< median fitness of the same individuals
    double diversity = 0;         ///< share of different genomes, in (0, 1]
};

/// Summarises a population under the objective that scored it last.
template <Problem P>
Summary summary(const P& problem, const PopulationOf<P>& population) {
    Summary summary;
    summary.individuals = population.size();
    std::vector<double> values;
    Table<bool> different;
    for (const auto& individual : population) {
        different.at(identify(problem, individual.genome)) = true;
        if (individual.fitness.has_value()) values.push_back(individual.value());
    }
    summary.diversity =
        population.empty() ? 0 : static_cast<double>(different.size()) / static_cast<double>(population.size());
    if (values.empty()) return summary;
    std::sort(values.begin(), values.end());
    summary.best = best_value(population);
    summary.median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
    return summary;
}

/// The status of a run on one line: "mine/repeat.1/score.1 generation 12: best 0.9812, 1300 evaluations".
template <class G>
std::string status(const Event<G>& event) {
    std::string line = event.path;
    if (!event.generation.empty()) line += " generation " + std::to_string(event.generation.back() + 1);
    if (const auto best = best_value(event.population)) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", *best);
        line += std::string(": best ") + text;
    }
    return line + ", " + std::to_string(event.counters.requested) + " evaluations";
}

/// An observer that passes the status to `show`, at most once per interval (s).
template <class G>
Observer<G> progress(std::function<void(const std::string&)> show, double interval = 0.1) {
    return [show = std::move(show), interval, next = 0.0](const Event<G>& event) mutable {
        if (event.seconds < next) return;
        next = event.seconds + interval;
        show(status(event));
    };
}

} // namespace ga
