#pragma once

#include "ga/problem/individual.hpp"

#include <cmath>
#include <functional>
#include <span>
#include <utility>

namespace ga {

/// The positions 0 to n-1 in the order of `before(a, b)`; ties in ascending order. The type of `before` is
/// erased, so that sorting is compiled only once.
std::vector<std::size_t> in_order(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& before);

/// Whether a is as good as b in every objective and better in one.
bool dominates(const Point& a, const Point& b);

/// The number of the front of each point, from 0 (Deb, Pratap, Agarwal and Meyarivan 2002). After fronts 0 to
/// r-1 are removed, no point dominates a point of front r. Points are sorted so that no later point dominates
/// an earlier one. Each point is compared only with earlier points (Zhang, Tian, Cheng and Jin 2015).
std::vector<std::size_t> pareto_ranks(const std::vector<Point>& points);

/// The crowding distance of each point in its front (Deb et al. 2002): the distance between its two
/// neighbours relative to the front's range, summed over objectives. It is infinite at the ends of a front.
std::vector<double> crowding_distances(const std::vector<Point>& points, const std::vector<std::size_t>& ranks);

/// A number of individuals that stands for all.
constexpr std::size_t all_individuals = static_cast<std::size_t>(-1);

/// Classes by Deb's rules (2000). Feasible individuals are first, in the order of falling merit. Infeasible
/// individuals follow, in the order of growing violation. Failed individuals are last. The first class is -1,
/// the next -2 and so on. Ties share a class.
std::vector<double> classes_by_rules(std::span<const Fitness* const> all);

/// NSGA-II's crowded comparison (Deb et al. 2002) as one number: -rank + c / (2 (1 + c)), with the rank of
/// the front, from 0, and the crowding distance c. Infeasible individuals follow, by their violation.
std::vector<double> crowded_merits(std::span<const Fitness* const> all);

/// The merit of each individual, compared with the other given individuals. Higher is better; failed individuals have
/// minus infinity. Under one objective the merit is the value, with its sign changed if the objective is minimised. If
/// any of the given individuals violates a constraint, all merits are classes by Deb's rules. Under several objectives
/// the merits are crowded_merits(). Throws UsageError if policies differ or an individual is unscored.
std::vector<double> merits(std::span<const Fitness* const> all);
/// The fitnesses of a population, followed by those of `others`.
template <class G>
std::vector<const Fitness*> fitnesses_of(const Population<G>& population, const Population<G>& others = {}) {
    std::vector<const Fitness*> all(population.size() + others.size());
    auto at = all.begin();
    for (const auto* part : {&population, &others})
        for (const auto& individual : *part) *at++ = &individual.fitness;
    return all;
}
/// The merits of a population, followed by the merits of `others`.
template <class G>
std::vector<double> merits(const Population<G>& population, const Population<G>& others = {}) {
    return merits(std::span<const Fitness* const>(fitnesses_of(population, others)));
}

/// Positions of the n best merits, best first; ties in their order.
std::vector<std::size_t> ranking(const std::vector<double>& merits, std::size_t n = all_individuals);
/// Positions of the n best individuals, best first, failed ones last; ties in the population's order.
template <class G>
std::vector<std::size_t> ranking(const Population<G>& population, std::size_t n = all_individuals) {
    return ranking(merits(population), n);
}

/// Copies of the individuals at these positions, in their order.
template <class G>
Population<G> individuals_at(const std::vector<std::size_t>& positions, const Population<G>& population) {
    Population<G> chosen;
    chosen.reserve(positions.size());
    for (const std::size_t i : positions) chosen.push_back(population[i]);
    return chosen;
}
/// The n best individuals, best first, failed ones last; all if there are fewer.
template <class G>
Population<G> best_of(const Population<G>& population, std::size_t n) {
    return individuals_at(ranking(population, n), population);
}

/// Replaces the worst individuals by others, the worst by the first, as far as there are as many.
template <class G>
void replace_worst(Population<G>& population, Population<G> by) {
    const std::vector<std::size_t> order = ranking(population);
    for (std::size_t i = 0; i < std::min(by.size(), order.size()); ++i)
        population[order[order.size() - 1 - i]] = std::move(by[i]);
}

/// The part of a generation's start that a block keeps: the best `reads` individuals, or all for `all_individuals`.
template <class G>
Population<G> start_of_generation(const Population<G>& population, std::size_t reads) {
    return reads == 0 ? Population<G>() : reads == all_individuals ? population : best_of(population, reads);
}

/// Sets all levels of the stage `epsilon` to 0, so that any violation makes an individual infeasible.
template <class G>
Population<G> without_levels(Population<G> population) {
    for (auto& individual : population)
        if (!individual.fitness.violations().empty()) individual.fitness = individual.fitness.relaxed({});
    return population;
}

/// The identities of a population, in ascending order.
template <class G>
std::vector<Identity> identities_of(const Population<G>& population) {
    std::vector<Identity> all;
    for (const auto& individual : population) all.push_back(individual.identity);
    std::sort(all.begin(), all.end());
    return all;
}

/// The population, followed by the individuals of `start` that it lacks.
template <class G>
Population<G> joined_with(const Population<G>& start, Population<G> population) {
    const std::vector<Identity> present = identities_of(population);
    for (const auto& old : start)
        if (!std::binary_search(present.begin(), present.end(), old.identity)) population.push_back(old);
    return population;
}

/// Implements `better` under constraints or several objectives.
bool better_by_rules(const Fitness& a, const Fitness& b);
/// Whether a is better than b by Deb's rules. Under several objectives, feasible individuals are compared by
/// dominance. The result depends only on a and b. Throws UsageError if the policies of a and b differ.
inline bool better(const Fitness& a, const Fitness& b) {
    const bool rules = a.several() || b.several() || !a.feasible() || !b.feasible();
    if (!rules && a.known() && b.known(a.objective_name())) // the most frequent case
        return a.merit() > b.merit();
    return better_by_rules(a, b);
}

/// Whether all individuals are scored under one policy.
template <class G>
bool comparable(const Population<G>& population) {
    return std::ranges::all_of(population, [&](const auto& each) {
        return each.fitness.known() && each.fitness.known(population.front().fitness.objective_name());
    });
}

/// The individuals that no other one dominates: under several objectives the Pareto front, under one
/// objective the best and its ties. Unscored and failed individuals are left out.
template <class G>
Population<G> front_of(const Population<G>& population) {
    Population<G> scored;
    for (const auto& individual : population)
        if (individual.fitness.known() && !individual.fitness.has_failed()) scored.push_back(individual);
    if (scored.empty()) return scored;
    const std::vector<double> worth = merits(scored);
    const double highest = std::ranges::max(worth);
    const bool several = scored.front().fitness.several();
    const double lowest = several ? std::min(0.0, highest) : highest; // the first front has merits from 0 on
    Population<G> front;
    for (std::size_t i = 0; i < scored.size(); ++i)
        if (worth[i] >= lowest) front.push_back(std::move(scored[i]));
    return front;
}

} // namespace ga
