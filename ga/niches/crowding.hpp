#pragma once

#include "ga/niches/distance.hpp"
#include "ga/pipeline/stage.hpp"

#include <map>

namespace ga {

/// Deterministic crowding (Mahfoud 1995, Niching methods for genetic algorithms, ch. 6): two children of the
/// same two parents are matched with these so that the distances within matches sum to the least; each that
/// is better than its match takes its place in the generation's start, which is the answer. A child of one
/// parent, or without a sibling next to it, is matched with the nearer of its parents. `random | cross`
/// before it mates everybody once.
struct Crowding : Operator {
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"crowding", "niches",
                "each child takes the place of the parent it is like, where it is better"};
    }
    static void describe(auto&, auto) {}
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    requires HasDistance<P> PopulationOf<P>
    operator()(PopulationOf<P> children, Context<P>& context) const {
        using G = typename P::Genome;
        auto population = context.generation_start();
        std::map<Identity, std::size_t> places; // of the start; a place keeps its name when it is taken
        for (std::size_t i = 0; i < population.size(); ++i)
            places[population[i].identity] = i;
        const auto parents_of = [&](const Individual<G>& child) {
            std::vector<std::size_t> found;
            for (const Identity parent : child.parents)
                if (const auto place = places.find(parent); place != places.end())
                    found.push_back(place->second);
            return found;
        };
        const auto apart = [&](const Individual<G>& child, std::size_t place) {
            return distance(context.problem(), child.genome, population[place].genome);
        };
        const auto match = [&](Individual<G>& child, std::size_t place) {
            if (better(child.fitness, population[place].fitness))
                population[place] = std::move(child);
        };
        for (std::size_t i = 0; i < children.size(); ++i) {
            Individual<G>& child = children[i];
            const auto parents = parents_of(child);
            if (parents.empty() || places.count(child.identity)) // nobody's child, or one of the start
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
    ///@}
};

/// The stage `crowding`.
inline Crowding crowding() { return {}; }

} // namespace ga
