#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// The number that a threshold keeps in any case.
struct AtLeast {
    std::size_t count = 0; ///< 0 for no minimum
};
/// The argument `at_least=count`.
inline AtLeast at_least(std::size_t count) { return {count}; }

/// The `at_least` individuals that come nearest to passing a threshold, without failed ones, in the
/// population's order.
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

/// The individuals above or below a threshold, or the at_least nearest; see Threshold.
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

/// Keeps the individuals with a fitness above a threshold (`below`: under it), in the population's order.
/// Failed individuals, and those that violate constraints, are removed. If fewer than at_least pass, the
/// at_least nearest are taken, with a note. An empty result ends the run.
template <bool upwards>
struct Threshold : Operator {
    double threshold = 0; ///< a fitness, not included
    AtLeast least;        ///< number that stays in any case
    ///@{ What every operator has (Operator).
    static Words words() {
        if (upwards)
            return {"above", "selection", "keeps those whose fitness is above the threshold"};
        return {"below", "selection", "keeps those whose fitness is below the threshold"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.threshold, number("threshold", std::nullopt, -no_limit, no_limit, "a fitness"));
        visit(self.least.count,
              whole("at_least", "0", 0, "if fewer pass, this number nearest to passing is taken")
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
