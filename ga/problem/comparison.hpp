#pragma once

#include "ga/problem/individual.hpp"

#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

namespace ga {

/// The positions 0 to n-1 in the order of `before(a, b)`; ties in ascending order. The type of `before` is
/// erased, so that sorting is compiled only once.
inline std::vector<std::size_t> in_order(std::size_t n,
                                         const std::function<bool(std::size_t, std::size_t)>& before) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&before](std::size_t a, std::size_t b) { return before(a, b) || (a < b && !before(b, a)); });
    return order;
}

/// Whether a is as good as b in every objective and better in one.
inline bool dominates(const Point& a, const Point& b) {
    bool better = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] < b[i])
            return false;
        better |= a[i] > b[i];
    }
    return better;
}

/// The number of the front of each point, from 0 (Deb, Pratap, Agarwal and Meyarivan 2002). After fronts 0 to
/// r-1 are removed, no point dominates a point of front r. Points are sorted so that no later point dominates
/// an earlier one. Each point is compared only with earlier points (Zhang, Tian, Cheng and Jin 2015).
inline std::vector<std::size_t> pareto_ranks(const std::vector<Point>& points) {
    const std::vector<std::size_t> order =
        in_order(points.size(), [&](std::size_t a, std::size_t b) { return points[a] > points[b]; });
    std::vector<std::vector<std::size_t>> fronts;
    std::vector<std::size_t> rank(points.size());
    for (const std::size_t each : order) {
        const auto free = std::partition_point(fronts.begin(), fronts.end(), [&](const auto& front) {
            return std::any_of(front.rbegin(), front.rend(),
                               [&](std::size_t other) { return dominates(points[other], points[each]); });
        });
        rank[each] = static_cast<std::size_t>(free - fronts.begin());
        if (free == fronts.end())
            fronts.push_back({each});
        else
            free->push_back(each);
    }
    return rank;
}

/// The crowding distance of each point in its front (Deb et al. 2002): the distance between its two
/// neighbours relative to the front's range, summed over objectives. It is infinite at the ends of a front.
inline std::vector<double> crowding_distances(const std::vector<Point>& points,
                                              const std::vector<std::size_t>& ranks) {
    std::vector<double> room(points.size(), 0);
    for (std::size_t k = 0; !points.empty() && k < points[0].size(); ++k) {
        const auto order = in_order(points.size(), [&](std::size_t a, std::size_t b) {
            return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : points[a][k] < points[b][k];
        });
        for (std::size_t first = 0, last; first < order.size(); first = last + 1) {
            last = first;
            while (last + 1 < order.size() && ranks[order[last + 1]] == ranks[order[first]])
                ++last;
            const double range = points[order[last]][k] - points[order[first]][k];
            room[order[first]] = room[order[last]] = HUGE_VAL;
            for (std::size_t i = first + 1; i < last && range > 0; ++i)
                room[order[i]] += (points[order[i + 1]][k] - points[order[i - 1]][k]) / range;
        }
    }
    return room;
}

/// A number of individuals that stands for all.
constexpr std::size_t all_individuals = static_cast<std::size_t>(-1);

/// Classes by Deb's rules (2000). Feasible individuals are first, in the order of falling merit. Infeasible
/// individuals follow, in the order of growing violation. Failed individuals are last. The first class is -1,
/// the next -2 and so on. Ties share a class.
inline std::vector<double> classes_by_rules(std::span<const Fitness* const> all) {
    const auto key = [&](std::size_t i) {
        const Fitness& f = *all[i];
        return std::pair(f.violation(), f.feasible() ? -f.merit() : 0.0);
    };
    const auto order = in_order(all.size(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<double> merits(all.size());
    double place = -1;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i - 1]) < key(order[i]))
            --place;
        merits[order[i]] = all[order[i]]->has_failed() ? -HUGE_VAL : place;
    }
    return merits;
}

/// NSGA-II's crowded comparison (Deb et al. 2002) as one number: -rank + c / (2 (1 + c)), with the rank of
/// the front, from 0, and the crowding distance c. Infeasible individuals follow, by their violation.
inline std::vector<double> crowded_merits(std::span<const Fitness* const> all) {
    std::vector<Point> points;
    std::vector<std::size_t> feasible, others;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]->feasible()) {
            feasible.push_back(i);
            points.push_back(all[i]->values());
        } else {
            others.push_back(i);
        }
    const std::vector<std::size_t> ranks = pareto_ranks(points);
    const std::vector<double> room = crowding_distances(points, ranks);
    std::vector<double> merits(all.size(), -HUGE_VAL);
    double last = 0;
    for (std::size_t i = 0; i < feasible.size(); ++i) {
        const double bonus = std::isfinite(room[i]) ? room[i] / (2 * (1 + room[i])) : 0.5;
        merits[feasible[i]] = -static_cast<double>(ranks[i]) + bonus;
        last = std::min(last, -static_cast<double>(ranks[i]));
    }
    double before = -HUGE_VAL;
    for (const std::size_t i : in_order(others.size(), [&](std::size_t a, std::size_t b) {
             return all[others[a]]->violation() < all[others[b]]->violation();
         }))
        if (const Fitness& each = *all[others[i]]; !each.has_failed()) {
            if (each.violation() > std::exchange(before, each.violation()))
                --last;
            merits[others[i]] = last;
        }
    return merits;
}

/// The merit of each individual, compared with the other given individuals. Higher is better; failed
/// individuals have minus infinity. Under one objective the merit is the value, with its sign changed if the
/// objective is minimised. If any of the given individuals violates a constraint, all merits are classes by
/// Deb's rules. Under several objectives the merits are crowded_merits(). Throws UsageError if policies
/// differ or an individual is unscored.
inline std::vector<double> merits(std::span<const Fitness* const> all) {
    bool several = false, ruled = false;
    std::vector<double> merits(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Fitness& each = *all[i];
        if (!each.known() || each.objective_name() != all[0]->objective_name())
            throw UsageError("fitness under '" + all[0]->objective() + "' was compared with '" +
                             each.objective() + "'; score all by one objective first");
        several |= each.several();
        ruled |= !each.feasible();
        merits[i] = several ? 0 : each.merit();
    }
    return several ? crowded_merits(all) : ruled ? classes_by_rules(all) : merits;
}
/// The merits of a population, followed by the merits of `others`.
template <class G>
std::vector<double> merits(const Population<G>& population, const Population<G>& others = {}) {
    std::vector<const Fitness*> all(population.size() + others.size());
    auto at = all.begin();
    for (const auto* part : {&population, &others})
        for (const auto& individual : *part)
            *at++ = &individual.fitness;
    return merits(std::span<const Fitness* const>(all));
}

/// Positions of the n best merits, best first; ties in their order.
inline std::vector<std::size_t> ranking(const std::vector<double>& merits, std::size_t n = all_individuals) {
    std::vector<std::size_t> order(merits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(n, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
        return merits[a] != merits[b] ? merits[a] > merits[b] : a < b;
    });
    order.erase(end, order.end());
    return order;
}
/// Positions of the n best individuals, best first, failed ones last; ties in the population's order.
template <class G>
std::vector<std::size_t> ranking(const Population<G>& population, std::size_t n = all_individuals) {
    return ranking(merits(population), n);
}

/// The n best individuals, best first, failed ones last; all if there are fewer.
template <class G>
Population<G> best_of(const Population<G>& population, std::size_t n) {
    Population<G> chosen;
    chosen.reserve(std::min(n, population.size()));
    for (const std::size_t i : ranking(population, n))
        chosen.push_back(population[i]);
    return chosen;
}

/// The part of a generation's start that a block keeps: the best `reads` individuals, or all for
/// `all_individuals`.
template <class G>
Population<G> start_of_generation(const Population<G>& population, std::size_t reads) {
    return reads == 0 ? Population<G>() : reads == all_individuals ? population : best_of(population, reads);
}

/// Sets all levels of the stage `epsilon` to 0, so that any violation makes an individual infeasible.
template <class G>
Population<G> without_levels(Population<G> population) {
    for (auto& individual : population)
        if (!individual.fitness.violations().empty())
            individual.fitness = individual.fitness.relaxed({});
    return population;
}

/// The identities of a population, in ascending order.
template <class G>
std::vector<Identity> identities_of(const Population<G>& population) {
    std::vector<Identity> all;
    for (const auto& individual : population)
        all.push_back(individual.identity);
    std::sort(all.begin(), all.end());
    return all;
}

/// The population, followed by the individuals of `start` that it lacks.
template <class G>
Population<G> joined_with(const Population<G>& start, Population<G> population) {
    const std::vector<Identity> present = identities_of(population);
    for (const auto& old : start)
        if (!std::binary_search(present.begin(), present.end(), old.identity))
            population.push_back(old);
    return population;
}

/// Implements `better` under constraints or several objectives.
inline bool better_by_rules(const Fitness& a, const Fitness& b) {
    const Fitness* const both[] = {&a, &b};
    const std::vector<double> worth = merits(both);
    return worth[0] > worth[1];
}
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
    return std::all_of(population.begin(), population.end(), [&](const auto& each) {
        return each.fitness.known() && each.fitness.known(population.front().fitness.objective_name());
    });
}

/// The individuals that no other one dominates: under several objectives the Pareto front, under one
/// objective the best and its ties. Unscored and failed individuals are left out.
template <class G>
Population<G> front_of(const Population<G>& population) {
    Population<G> scored;
    for (const auto& individual : population)
        if (individual.fitness.known() && !individual.fitness.has_failed())
            scored.push_back(individual);
    const std::vector<double> worth = merits(scored);
    const bool several = !scored.empty() && scored.front().fitness.several();
    const double highest = worth.empty() ? 0 : *std::max_element(worth.begin(), worth.end());
    const double lowest =
        several ? std::min(0.0, highest) : highest; // merits of the first front are 0 or more
    Population<G> front;
    for (std::size_t i = 0; i < scored.size(); ++i)
        if (worth[i] >= lowest)
            front.push_back(std::move(scored[i]));
    return front;
}

} // namespace ga
