#pragma once

#include "ga/niches/distance.hpp"
#include "ga/selection/proportional.hpp"

namespace ga {

/// Fitness sharing (Goldberg and Richardson 1987): the fitness divided by how crowded its niche is, sum over
/// all of sh(d) = 1 - (d/radius)^alpha for distances below `radius`; chosen by stochastic universal sampling.
/// Where any fitness is below 0, all are raised so that the worst is 0: hills keep their shares of heights
/// above that.
struct Sharing : ByFitness {
    static constexpr bool one_spin = true; ///< one for all places

    double radius = 0.1; ///< of a niche, above 0
    double alpha = 1;    ///< of the sharing function, above 0

    /// One an individual.
    template <HasDistance P>
    std::vector<double> of(const PopulationOf<P>& population, const P& problem) const {
        std::vector<double> shared = ByFitness::of(population); // 0 for who does not count
        double lowest = 0, highest = -HUGE_VAL;
        for (std::size_t i = 0; i < population.size(); ++i)
            if (const Fitness& f = population[i].fitness; !f.has_failed() && f.feasible()) {
                lowest = std::min(lowest, f.merit());
                highest = std::max(highest, f.merit());
            }
        for (std::size_t i = 0; i < population.size(); ++i)
            if (const Fitness& f = population[i].fitness; highest > lowest && !f.has_failed() && f.feasible())
                shared[i] = f.merit() - lowest;
        std::vector<double> crowd(population.size(), 1);
        for (std::size_t i = 0; i < population.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double d = distance(problem, population[i].genome, population[j].genome);
                const double share = d < radius ? 1 - std::pow(d / radius, alpha) : 0;
                crowd[i] += share, crowd[j] += share;
            }
        for (std::size_t i = 0; i < shared.size(); ++i)
            shared[i] /= crowd[i];
        return shared;
    }
    /// In the listing.
    static Words words() {
        return {"share", "niches", "chooses in proportion to the fitness shared with those nearby"};
    }
    /// Its parameters.
    static void describe(auto& self, auto visit) {
        visit(self.radius, number("radius", std::nullopt, above_zero, no_limit,
                                  "of a niche: rms of genes in widths, or share of bits that differ"));
        visit(self.alpha,
              number("alpha", "1", above_zero, no_limit, "of the sharing function").keyed().quiet());
    }
};

/// @param radius  of a niche, in the problem's distance
inline Proportional<Sharing> share(double radius, double alpha = 1) {
    return checked(Proportional<Sharing>{{}, Sharing{{}, radius, alpha}});
}

} // namespace ga
