#pragma once

#include "ga/pareto/pareto.hpp"

namespace ga {

/// Positions of the mu individuals that SMS-EMOA keeps (Beume, Naujoks and Emmerich 2007): whole fronts from
/// the first on, while they fit. From the next front, the individual with the smallest exclusive hypervolume
/// is removed until all others fit. Objectives are divided by their ranges in this front. The reference point
/// is `beyond` ranges below the worst values. Infeasible individuals follow, by their violation.
std::vector<std::size_t> chosen_by_hypervolume(std::span<const Fitness* const> all, std::size_t mu, double beyond);

/// The points on the unit simplex whose coordinates are multiples of 1/divisions (Das and Dennis 1998):
/// C(divisions + objectives - 1, divisions). With `inner` above 0, a second layer has that many divisions; it
/// is shrunk by half towards the centre (Deb and Jain 2014).
std::vector<Point> reference_directions(std::size_t objectives, std::size_t divisions, std::size_t inner);

/// Positions of the mu individuals that NSGA-III keeps (Deb and Jain 2014): whole fronts from the first on,
/// while they fit. The next front fills the directions that have the fewest individuals. Objectives are
/// shifted by their best values and divided by the worst values of the extreme individuals. The paper divides
/// by intercepts of the plane through these.
std::vector<std::size_t> chosen_by_directions(std::span<const Fitness* const> all, std::size_t mu,
                                              const std::vector<Point>& directions, Stream& stream);

/// Selection by hypervolume, for up to five objectives. One generation of SMS-EMOA with mu = 100 is
///
///     random | tournament 1 size=2 | cross sbx | mutate 0.1 polynomial | pareto f1 f2 | parents |
///         hypervolume 100
struct HypervolumeSelection : Operator {
    std::size_t mu = 100; ///< number of individuals that stay, >= 1
    double beyond = 1;    ///< distance of the reference point from the worst values, in ranges, > 0
    static constexpr std::size_t max_objectives = 5; ///< the exact volume takes too long for more
    static Words words() {
        return {"hypervolume", "selection", "keeps mu by front, then by exclusive hypervolume (SMS-EMOA)"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.mu, whole("mu", std::nullopt, 1, "how many"));
        visit(self.beyond,
              number("beyond", above_zero, 1e6, "reference point below the worst, in ranges").keyed().quiet());
    }
    void check(CheckState& known) const;

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto chosen = chosen_by_hypervolume(fitnesses_of(population), mu, beyond);
        return context.gather(std::move(population), chosen);
    }
};

/// Selection by reference directions, for three objectives and more (NSGA-III).
struct ReferenceDirections : Operator {
    std::size_t mu = 100;      ///< number of individuals that stay, >= 1
    std::size_t divisions = 0; ///< divisions of an edge; 0: as many as give at most mu directions
    std::size_t inner = 0;     ///< divisions of the second layer; 0 for none, or if divisions is 0, by mu
    static Words words() {
        return {"directions", "selection", "keeps mu by front, then near reference directions (NSGA-III)"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.mu, whole("mu", std::nullopt, 1, "how many"));
        visit(self.divisions,
              whole("divisions", 0, "of an edge of the simplex; 0: as many as fit mu").up_to(1000).keyed().quiet());
        visit(self.inner, whole("inner", 0, "of the second layer; 0: none").up_to(1000).keyed().quiet());
    }
    void check(CheckState& known) const { known.need_several_objectives(text_of(*this)); }
    /// The directions for this number of objectives.
    std::vector<Point> of(std::size_t objectives) const;

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        std::size_t objectives = 0;
        for (const auto& each : population) objectives = std::max(objectives, each.fitness.values().size());
        if (objectives == 0) // all have failed
            return best_of(population, mu);
        Stream stream = context.stream(0);
        const auto chosen = chosen_by_directions(fitnesses_of(population), mu, of(objectives), stream);
        return context.gather(std::move(population), chosen);
    }
};

///@{ The operators as stages.
inline HypervolumeSelection by_hypervolume(std::size_t mu, double beyond = 1) {
    return checked(HypervolumeSelection{{}, mu, beyond});
}
inline ReferenceDirections directions(std::size_t mu, std::size_t divisions = 0, std::size_t inner = 0) {
    return checked(ReferenceDirections{{}, mu, divisions, inner});
}
///@}

} // namespace ga
