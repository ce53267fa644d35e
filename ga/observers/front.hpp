#pragma once

#include "ga/pareto/pareto.hpp"

namespace ga {

/// The front of a population under several objectives, and the volume above a reference point that it
/// dominates.
template <class G>
struct FrontEvent {
    const Event<G>& event; ///< event of the stage that returned the population
    Population<G> front;   ///< individuals that no other one dominates
    double hypervolume;    ///< volume above the reference; only feasible individuals count
};

/// Calls show(FrontEvent) after every stage with a path that ends in `stage`, if the population is scored
/// under several objectives. This needs no evaluations.
/// @param reference  one value per objective, with higher being better
template <class G>
Observer<G> fronts(std::string stage, Point reference, std::function<void(const FrontEvent<G>&)> show) {
    return [stage = std::move(stage), reference = std::move(reference),
            show = std::move(show)](const Event<G>& event) {
        if (!event.path.ends_with(stage) || event.population.empty() || !comparable(event.population) ||
            event.population.front().fitness.objective().find(' ') == std::string::npos)
            return;
        FrontEvent<G> seen{event, ga::front_of(event.population), 0};
        std::vector<Point> points;
        for (const auto& individual : seen.front)
            if (individual.fitness.feasible() && individual.fitness.several())
                points.push_back(individual.fitness.values());
        seen.hypervolume = hypervolume(std::move(points), reference);
        show(seen);
    };
}

} // namespace ga
