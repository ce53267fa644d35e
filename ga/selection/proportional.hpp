#pragma once

#include "ga/pipeline/stage.hpp"

#include <numeric>

namespace ga {

/// Weights by the fitness above the worst (windowing), so that any fitness is allowed and the worst is never
/// chosen. If all are equal, the weights are equal. Failed individuals have weight 0; so have infeasible ones
/// if any is feasible.
struct ByFitness {
    /// In [0, 1], one per individual.
    template <class G>
    std::vector<double> of(const Population<G>& population) const {
        const bool any_feasible = std::any_of(population.begin(), population.end(), [](const auto& each) {
            return !each.fitness.has_failed() && each.fitness.feasible();
        });
        std::vector<double> weights;
        for (const auto& individual : population) {
            const Fitness& f = individual.fitness;
            const bool counts = !f.has_failed() && (f.feasible() || !any_feasible);
            weights.push_back(!counts ? -HUGE_VAL : any_feasible ? f.merit() : -f.violation());
        }
        const double best = *std::max_element(weights.begin(), weights.end());
        double worst = best;
        for (const double weight : weights)
            if (weight > -HUGE_VAL)
                worst = std::min(worst, weight);
        for (double& weight : weights)
            weight = !(best > -HUGE_VAL)   ? 1
                     : weight == -HUGE_VAL ? 0
                     : best > worst        ? (weight - worst) / (best - worst)
                                           : 1;
        return weights;
    }
    void check(const CheckState& known, const std::string& stage) const {
        known.need_one_objective(stage);
    }                                    ///< as it says
    static void describe(auto&, auto) {} ///< no parameters
};

/// Roulette: one spin for every place.
struct Roulette : ByFitness {
    static constexpr bool one_spin = false; ///< a spin for every place
    /// In the listing.
    static Words words() {
        return {"roulette", "selection", "chooses in proportion to the fitness above the worst"};
    }
};
/// Stochastic universal sampling (Baker 1987): equally spaced marks on one spin fill all places. Every
/// individual gets its expected number of places, rounded up or down.
struct Universal : ByFitness {
    static constexpr bool one_spin = true; ///< one for all places
    /// In the listing.
    static Words words() {
        return {"sus", "selection", "like roulette, by equally spaced marks on one spin"};
    }
};

/// Linear ranking (Baker 1985): the best has weight `pressure`, the worst 2 - pressure, linear between them.
struct ByRank {
    static constexpr bool one_spin = false; ///< a spin for every place

    double pressure = 1.5; ///< weight of the best, above 1 and at most 2

    /// In [0, pressure], one per individual.
    template <class G>
    std::vector<double> of(const Population<G>& population) const {
        const std::vector<std::size_t> order = ranking(population);
        const double last = static_cast<double>(order.size()) - 1;
        std::vector<double> weights(order.size(), 1);
        for (std::size_t place = 0; place < order.size() && last > 0; ++place)
            weights[order[place]] = pressure - 2 * (pressure - 1) * static_cast<double>(place) / last;
        return weights;
    }
    /// Works under any policy.
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }
    /// In the listing.
    static Words words() { return {"rank", "selection", "chooses in linear proportion to the rank"}; }
    /// Its one parameter.
    static void describe(auto& self, auto visit) {
        visit(self.pressure, number("pressure", "1.5", 1.0001, 2, "expected places of the best"));
    }
};

/// Fills the population by choosing in proportion to weights, with replacement.
template <class Weights>
struct Proportional : Operator {
    Weights weights; ///< Roulette, Universal, ByRank or Sharing
    ///@{ What every operator has (Operator).
    static Words words() { return Weights::words(); }
    static void describe(auto& self, auto visit) { Weights::describe(self.weights, visit); }
    void check(CheckState& known) const { weights.check(known, text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const std::size_t n = population.size();
        if (population.empty())
            return population;
        std::vector<double> ends;
        if constexpr (requires { weights.of(population, context.problem()); })
            ends = weights.of(population, context.problem());
        else
            ends = weights.of(population);
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
        Stream spin = context.stream(n);
        const double offset = spin.uniform();
        std::vector<std::size_t> places(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double mark = Weights::one_spin ? (static_cast<double>(i) + offset) / static_cast<double>(n)
                                                  : context.stream(i).uniform();
            const auto end = std::upper_bound(ends.begin(), ends.end() - 1, mark * ends.back());
            places[i] = static_cast<std::size_t>(end - ends.begin());
        }
        // One spin gives copies of an individual neighbouring places; shuffled, they do not always mate.
        for (std::size_t i = n; Weights::one_spin && i > 1; --i)
            std::swap(places[i - 1], places[spin.below(i)]);
        return context.gather(std::move(population), places);
    }
    ///@}
};

/// The stage `roulette`.
inline Proportional<Roulette> roulette() { return {}; }
/// The stage `sus`.
inline Proportional<Universal> sus() { return {}; }
/// @param pressure  expected places of the best, above 1 and at most 2
inline Proportional<ByRank> rank(double pressure = 1.5) {
    return checked(Proportional<ByRank>{{}, ByRank{pressure}});
}

} // namespace ga
