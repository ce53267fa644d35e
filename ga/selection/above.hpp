#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// How many a threshold keeps in any case.
struct AtLeast {
    std::size_t count = 0; ///< 0: nobody in particular
};
/// The argument `at_least=count`.
inline AtLeast at_least(std::size_t count) { return {count}; }

/// So many of those who have not failed that come nearest to passing a threshold, in the population's order.
template <class G>
[[gnu::cold]] Population<G> nearest_to_passing(const Population<G>& population, std::size_t at_least,
                                               bool upwards) {
    auto order = in_order(population.size(), [&](std::size_t a, std::size_t b) {
        const Fitness &x = population[a].fitness, &y = population[b].fitness;
        return std::pair(x.violation(), upwards ? -x.value() : x.value()) <
               std::pair(y.violation(), upwards ? -y.value() : y.value());
    });
    std::erase_if(order, [&](std::size_t i) { return population[i].fitness.has_failed(); });
    order.resize(std::min(at_least, order.size()));
    std::sort(order.begin(), order.end());
    Population<G> nearest;
    for (const std::size_t i : order)
        nearest.push_back(population[i]);
    return nearest;
}

/// Those who pass a threshold upwards or downwards, or the at_least nearest; see Threshold.
template <Problem P, class G = typename P::Genome>
[[gnu::noinline]] Population<G> passing(const Population<G>& population, double threshold, AtLeast least,
                                        bool upwards, Context<P>& context) {
    Population<G> passed;
    for (const auto& individual : population)
        if (const Fitness& f = individual.fitness;
            !f.has_failed() && f.feasible() && (upwards ? f.value() > threshold : f.value() < threshold))
            passed.push_back(individual);
    if (passed.size() >= std::max<std::size_t>(1, least.count))
        return passed;
    const std::string counted = std::to_string(passed.size()) + " of " + std::to_string(population.size()) +
                                (upwards ? " above " : " below ") + number(threshold);
    Population<G> nearest = nearest_to_passing(population, least.count, upwards);
    if (nearest.empty())
        throw NothingLeft(context.path() + ": " + counted + "; expected one at least, or at_least=K");
    context.note(counted + "; took the " + std::to_string(nearest.size()) + (upwards ? " best" : " lowest"));
    return nearest;
}

/// Keeps those whose fitness, as its objective states it, is above (or, for `below`, under) a threshold, in
/// the population's order; failed ones and those that violate constraints go. When fewer than at_least pass,
/// the at_least nearest to passing are taken and the run's notes say so; without it, an empty answer ends the
/// run.
template <bool upwards>
struct Threshold : Operator {
    double threshold = 0; ///< of fitness, not included
    AtLeast least;        ///< who stay in any case
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        if (upwards)
            return {"above", "selection", "keeps those whose fitness is above the threshold"};
        return {"below", "selection", "keeps those whose fitness is below the threshold"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.threshold, number("threshold", std::nullopt, -no_limit, no_limit, "a fitness"));
        visit(self.least.count,
              whole("at_least", "0", 0, "where fewer pass, so many nearest to passing are taken")
                  .keyed()
                  .quiet());
    }
    void check(CheckState& known) const { known.need_one_objective(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        return passing(population, threshold, least, upwards, context);
    }
    ///@}
};

/// The stage `above threshold at_least=...`.
inline Threshold<true> above(double threshold, AtLeast least = {}) {
    return checked(Threshold<true>{{}, threshold, least});
}
/// The stage `below threshold at_least=...`.
inline Threshold<false> below(double threshold, AtLeast least = {}) {
    return checked(Threshold<false>{{}, threshold, least});
}

} // namespace ga
