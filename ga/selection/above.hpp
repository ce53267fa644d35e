#pragma once

#include "ga/selection/best.hpp"
#include "ga/text/number.hpp"

namespace ga {

/// How many a threshold keeps in any case.
struct AtLeast {
    std::size_t count = 0; ///< 0: nobody in particular
};
/// The argument `at_least=count`.
inline AtLeast at_least(std::size_t count) { return {count}; }

/// Keeps those whose fitness is above (or, for `below`, under) a threshold, in the population's order; failed
/// ones go. When fewer than at_least pass, the at_least nearest to passing are taken and the run's notes say
/// so; without it, an empty answer ends the run.
struct Threshold : Operator {
    double threshold; ///< of fitness, not included
    bool upwards;     ///< `above`, not `below`
    AtLeast least;    ///< who stay in any case

    /// `above value` where `up`, `below value` where not.
    Threshold(double value, bool up, AtLeast at) : threshold(value), upwards(up), least(at) {}
    ///@{
    /// What every operator has (Operator).
    std::string text() const {
        return std::string(upwards ? "above " : "below ") + number(threshold) +
               (least.count > 0 ? " at_least=" + std::to_string(least.count) : "");
    }
    void check(Known& known) const { known.need_score(text()); }

    std::optional<Demand> demand() const {
        return upwards ? std::optional(Demand{least.count, threshold}) : std::nullopt;
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        using G = typename P::Genome;
        Population<G> passed;
        for (const auto& individual : population)
            if (!individual.fitness.has_failed() &&
                (upwards ? individual.value() > threshold : individual.value() < threshold))
                passed.push_back(individual);
        if (passed.size() >= std::max<std::size_t>(1, least.count))
            return passed;
        const std::string counted = std::to_string(passed.size()) + " of " +
                                    std::to_string(population.size() + context.left_out()) +
                                    (upwards ? " above " : " below ") + number(threshold);
        Population<G> nearest = nearest_to_passing(population);
        if (nearest.empty())
            throw NothingLeft(context.path() + ": " + counted + "; expected one at least, or at_least=K");
        context.note(counted + "; took the " + std::to_string(nearest.size()) +
                     (upwards ? " best" : " lowest"));
        return nearest;
    }
    ///@}

  private:
    template <class G>
    Population<G> nearest_to_passing(const Population<G>& population) const {
        std::vector<std::size_t> order = ranking(population);
        std::erase_if(order, [&](std::size_t i) { return population[i].fitness.has_failed(); });
        if (!upwards)
            std::reverse(order.begin(), order.end());
        order.resize(std::min(least.count, order.size()));
        std::sort(order.begin(), order.end());
        Population<G> nearest;
        for (const std::size_t i : order)
            nearest.push_back(population[i]);
        return nearest;
    }
};

/// The stage `above threshold at_least=...`.
inline Threshold above(double threshold, AtLeast least = {}) { return {threshold, true, least}; }
/// The stage `below threshold at_least=...`.
inline Threshold below(double threshold, AtLeast least = {}) { return {threshold, false, least}; }

} // namespace ga
