#pragma once

#include "ga/selection/best.hpp"
#include "ga/text/number.hpp"

namespace ga {

/// How much each individual counts in selection: its fitness above that of the worst (windowing, so that any
/// fitness will do and the worst is never chosen); all the same where all are equal. Failed individuals count
/// nothing.
struct ByFitness {
    /// In [0, 1], one an individual.
    template <class G>
    std::vector<double> operator()(const Population<G>& population) const {
        double worst = HUGE_VAL, best = -HUGE_VAL;
        for (const auto& individual : population)
            if (!individual.fitness.has_failed()) {
                worst = std::min(worst, individual.value());
                best = std::max(best, individual.value());
            }
        std::vector<double> weights;
        for (const auto& individual : population)
            weights.push_back(!(best > -HUGE_VAL)               ? 1
                              : individual.fitness.has_failed() ? 0
                              : best > worst ? (individual.value() - worst) / (best - worst)
                                             : 1);
        return weights;
    }
};

/// Linear ranking (Baker 1985): the best counts `pressure`, the worst 2 - pressure, on a straight line
/// between.
struct ByRank {
    double pressure; ///< of the best, in [1, 2]

    /// In [0, pressure], one an individual.
    template <class G>
    std::vector<double> operator()(const Population<G>& population) const {
        const std::vector<std::size_t> order = ranking(population);
        const double last = static_cast<double>(order.size()) - 1;
        std::vector<double> weights(order.size(), 1);
        for (std::size_t place = 0; place < order.size() && last > 0; ++place)
            weights[order[place]] = pressure - 2 * (pressure - 1) * static_cast<double>(place) / last;
        return weights;
    }
};

/// Chooses in proportion to weights: every place by a spin of its own (roulette), or all by equally spaced
/// marks on one spin (stochastic universal sampling, Baker 1987), which leaves no individual more than one
/// place from its due.
template <class Weights>
struct Proportional : Operator {
    std::string words; ///< the stage as text
    Weights weights;   ///< how much each individual counts: ByFitness or ByRank
    bool one_spin;     ///< universal sampling, not roulette

    /// `text_` is the stage as pipelines write it.
    Proportional(std::string text_, Weights weights_, bool once)
        : words(std::move(text_)), weights(weights_), one_spin(once) {}
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return words; }
    void check(Known& known) const { known.need_score(text()); }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        const std::size_t n = population.size();
        std::vector<double> ends = weights(population);
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
        Stream spin = context.stream(n);
        const double offset = spin.uniform();
        std::vector<std::size_t> places(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double mark = one_spin ? (static_cast<double>(i) + offset) / static_cast<double>(n)
                                         : context.stream(i).uniform();
            const auto end = std::upper_bound(ends.begin(), ends.end() - 1, mark * ends.back());
            places[i] = static_cast<std::size_t>(end - ends.begin());
        }
        // One spin meets the individuals in order: neighbours must not be mates for that.
        for (std::size_t i = n; one_spin && i > 1; --i)
            std::swap(places[i - 1], places[spin.below(i)]);
        return context.gather(std::move(population), places);
    }
    ///@}
};

/// The stage `roulette`.
inline Proportional<ByFitness> roulette() { return {"roulette", {}, false}; }
/// The stage `sus`.
inline Proportional<ByFitness> sus() { return {"sus", {}, true}; }
/// @param pressure  expected places of the best, in (1, 2]
inline Proportional<ByRank> rank(double pressure = 1.5) {
    if (!(pressure > 1 && pressure <= 2))
        throw UsageError("rank: pressure is " + number(pressure) + "; expected above 1 and at most 2");
    return {"rank " + number(pressure), {pressure}, true};
}

} // namespace ga
