#pragma once

#include "ga/selection/selection.hpp"
#include "ga/variation/distance.hpp"

namespace ga {

/// Clearing (Petrowski 1996). Individuals are visited from the best to the worst. An individual is removed if
/// `capacity` better individuals that stay are within the distance `radius`. The result is sorted, best first.
struct Clearing : Operator {
    double radius = 0.1;      ///< niche radius, above 0
    std::size_t capacity = 1; ///< number of individuals per niche, >= 1

    static constexpr const char* needs = no_distance;
    static Words words() { return {"clear", "niches", "keeps the best of every niche, best first"}; }
    static void describe(auto& self, auto visit) {
        visit(self.radius, number("radius", std::nullopt, above_zero, no_limit,
                                  "niche radius: rms of genes in widths, or share of bits that differ"));
        visit(self.capacity, whole("capacity", 1, "individuals per niche").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <HasDistance P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        PopulationOf<P> left;
        for (const std::size_t i : ranking(population)) {
            const auto near = std::ranges::count_if(left, [&](const auto& better) {
                return distance(context.problem(), better.genome, population[i].genome) < radius;
            });
            if (static_cast<std::size_t>(near) < capacity) left.push_back(std::move(population[i]));
        }
        return left;
    }
};

/// Deterministic crowding (Mahfoud 1995, Niching methods for genetic algorithms, ch. 6). The result is the
/// generation's start, in which children replace parents that are worse. Two children of the same two parents
/// are matched with these parents so that the sum of distances is smallest. A child replaces the parent with
/// which it is matched if the child is better. A child that has one parent, or no sibling next to it, is
/// matched with its nearest parent. Put `random | cross` before this stage to mate every individual once.
struct Crowding : Operator {
    static constexpr const char* needs = no_distance;
    static Words words() {
        return {"crowding", "niches", "each child replaces its more similar parent if it is better"};
    }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <HasDistance P>
    PopulationOf<P> operator()(PopulationOf<P> children, Context<P>& context) const {
        using G = typename P::Genome;
        auto population = context.generation_start();
        std::map<Identity, std::size_t> places; // places in the start, by the identity that was there first
        for (std::size_t i = 0; i < population.size(); ++i) places[population[i].identity] = i;
        const auto parents_of = [&](const Individual<G>& child) {
            std::vector<std::size_t> found;
            for (const Identity parent : child.parents)
                if (const auto place = places.find(parent); place != places.end()) found.push_back(place->second);
            return found;
        };
        const auto apart = [&](const Individual<G>& child, std::size_t place) {
            return distance(context.problem(), child.genome, population[place].genome);
        };
        const auto match = [&](Individual<G>& child, std::size_t place) {
            if (better(child.fitness, population[place].fitness)) population[place] = std::move(child);
        };
        for (std::size_t i = 0; i < children.size(); ++i) {
            Individual<G>& child = children[i];
            const auto parents = parents_of(child);
            if (parents.empty() || places.count(child.identity)) // no child of the start, or a member of it
                continue;
            if (parents.size() == 1) {
                match(child, parents[0]);
            } else if (i + 1 < children.size() && children[i + 1].parents == child.parents) {
                Individual<G>& sibling = children[++i];
                const double straight = apart(child, parents[0]) + apart(sibling, parents[1]);
                const double across = apart(child, parents[1]) + apart(sibling, parents[0]);
                match(child, parents[straight <= across ? 0 : 1]);
                match(sibling, parents[straight <= across ? 1 : 0]);
            } else {
                match(child, parents[apart(child, parents[0]) <= apart(child, parents[1]) ? 0 : 1]);
            }
        }
        return population;
    }
};

/// Fitness sharing (Goldberg and Richardson 1987) with stochastic universal sampling. The fitness of an individual is
/// divided by the size of its niche. This size is the sum of 1 - (d/radius)^alpha over all individuals whose distance d
/// is below `radius`. If a fitness is below 0, all fitnesses are first raised so that the worst is 0.
struct Sharing : ByFitness {
    static constexpr const char* needs = no_distance; ///< members that the problem must have, for the listing
    static constexpr bool one_spin = true;            ///< whether one spin fills all places

    double radius = 0.1; ///< niche radius, above 0
    double alpha = 1;    ///< exponent of the sharing function, above 0

    /// The weights, one per individual.
    template <HasDistance P>
    std::vector<double> of(const PopulationOf<P>& population, const P& problem) const {
        auto shared = ByFitness::of(population, problem); // 0 for individuals that do not count
        double lowest = 0, highest = -HUGE_VAL;
        for (std::size_t i = 0; i < population.size(); ++i)
            if (const Fitness& f = population[i].fitness; f.feasible()) {
                lowest = std::min(lowest, f.merit());
                highest = std::max(highest, f.merit());
            }
        for (std::size_t i = 0; i < population.size(); ++i)
            if (const Fitness& f = population[i].fitness; highest > lowest && f.feasible())
                shared[i] = f.merit() - lowest;
        std::vector<double> crowd(population.size(), 1);
        for (std::size_t i = 0; i < population.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double d = distance(problem, population[i].genome, population[j].genome);
                const double share = d < radius ? 1 - std::pow(d / radius, alpha) : 0;
                crowd[i] += share, crowd[j] += share;
            }
        for (std::size_t i = 0; i < shared.size(); ++i) shared[i] /= crowd[i];
        return shared;
    }
    static Words words() {
        return {"share", "niches", "chooses in proportion to the fitness divided by the crowd nearby"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.radius, number("radius", std::nullopt, above_zero, no_limit,
                                  "niche radius: rms of genes in widths, or share of bits that differ"));
        visit(self.alpha, number("alpha", above_zero, no_limit, "exponent of the sharing function").keyed().quiet());
    }
};

///@{ The operators as stages.
inline Clearing clear(double radius, std::size_t capacity = 1) { return checked(Clearing{{}, radius, capacity}); }
inline Crowding crowding() { return {}; }
inline Proportional<Sharing> share(double radius, double alpha = 1) {
    return checked(Proportional<Sharing>{{}, Sharing{{}, radius, alpha}});
}
///@}

} // namespace ga
