#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Keeps the n best, best first. n >= 1.
struct Best : Operator {
    std::size_t n = 1;                       ///< number of individuals that stay, >= 1
    static constexpr bool keeps_size = true; ///< it adds no individual
    static Words words() { return {"best", "selection", "keeps the n best, best first"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }
    void check(CheckState& known) const {
        known.need_score(text_of(*this));
        known.at_most = std::min(known.at_most, n);
    }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>&) const {
        return best_of(population, n);
    }
};

/// Keeps n different individuals at random, in random order. If there are fewer, all stay, in random order.
struct Random : Operator {
    std::size_t n = 0; ///< number of individuals that stay; 0 for all
    static Words words() { return {"random", "selection", "keeps n at random, none twice, in random order"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", 0, "how many; 0 for all").quiet()); }
    void check(CheckState&) const {}

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        Stream stream = context.stream(0);
        for (std::size_t i = 0; i + 1 < population.size(); ++i)
            std::swap(population[i], population[i + stream.below(population.size() - i)]);
        if (n > 0 && n < population.size()) population.resize(n);
        return population;
    }
};

/// Fills each place with the best of k individuals that are drawn with replacement (Brindle 1981). On a tie
/// the individual that was drawn first is chosen. The best of a large population gets about k places. With
/// `draw=each`, individuals are drawn from a shuffled list of all, which is shuffled again when it is empty.
/// So each competes k times, as in NSGA-II (Deb et al. 2002).
struct Tournament : Operator {
    std::size_t k = 2;        ///< number of individuals drawn for each place, >= 1
    std::size_t size = 0;     ///< number of places; 0 for the population's size
    std::string draw = "any"; ///< whether `any` may be drawn, or `each` equally often
    static Words words() { return {"tournament", "selection", "each place goes to the best of k drawn at random"}; }
    static void describe(auto& self, auto visit) {
        visit(self.k, whole("k", 1, "how many are drawn"));
        visit(self.size, whole("size", 0, "places; 0 for as many as there are").keyed().quiet());
        visit(self.draw, word("draw", "any, or each: all compete equally often").keyed().quiet());
    }
    void validate() const {
        if (draw != "any" && draw != "each")
            throw UsageError("stage 'tournament': draw is '" + draw + "'; use any or each");
    }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        if (population.empty()) return population;
        context.need_room(size, population);
        const std::vector<double> worth = merits(population);
        const Below any(population.size());
        const bool each = draw == "each";
        Permutation list; // with `each`, the individuals that still have to compete
        const auto drawn = [&](Stream& stream) -> std::size_t {
            if (!each) return any(stream);
            if (list.order.empty()) list = Permutation::random(population.size(), stream);
            const std::size_t last = list.order.back();
            list.order.pop_back();
            return last;
        };
        std::vector<std::size_t> winners(size > 0 ? size : population.size());
        Stream next = context.stream(0); // computed early, while the present one is used
        for (std::size_t i = 0; i < winners.size(); ++i) {
            Stream stream = std::exchange(next, context.stream(i + 1));
            std::size_t winner = drawn(stream);
            for (std::size_t draws = 1; draws < k; ++draws)
                if (const std::size_t rival = drawn(stream); worth[rival] > worth[winner]) winner = rival;
            winners[i] = winner;
        }
        return context.gather(std::move(population), winners);
    }
};

/// The minimum number of individuals that a threshold keeps.
struct AtLeast {
    std::size_t count = 0; ///< number; 0 for no minimum
};

/// The individuals above a threshold (below it if `upwards` is false), or the nearest ones; see Threshold.
template <Problem P, class G = typename P::Genome>
[[gnu::noinline]] Population<G> passing(const Population<G>& population, double threshold, AtLeast least, bool upwards,
                                        Context<P>& context) {
    Population<G> passed;
    for (const auto& individual : population)
        if (const Fitness& f = individual.fitness;
            f.feasible() && (upwards ? f.value() > threshold : f.value() < threshold))
            passed.push_back(individual);
    if (passed.size() >= std::max<std::size_t>(1, least.count)) return passed;
    const std::string counted = std::to_string(passed.size()) + " of " + std::to_string(population.size()) +
                                (upwards ? " above " : " below ") + number(threshold);
    const auto distance = [&](std::size_t i) { // to passing
        const Fitness& f = population[i].fitness;
        return std::pair(f.violation(), upwards ? -f.value() : f.value());
    };
    auto nearest = in_order(population.size(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    std::erase_if(nearest, [&](std::size_t i) { return population[i].fitness.has_failed(); });
    nearest.resize(std::min(least.count, nearest.size()));
    if (nearest.empty()) context.end_with(population, counted + "; change the bound, or give at_least=K");
    context.note(counted + "; took the " + std::to_string(nearest.size()) + (upwards ? " best" : " lowest"));
    std::sort(nearest.begin(), nearest.end());
    return individuals_at(nearest, population);
}

/// Keeps the individuals with a fitness above a threshold (`below`: under it), in the population's order.
/// Failed individuals and individuals that violate constraints do not pass. If fewer than at_least pass, the
/// at_least individuals nearest to passing are taken, with a note. Nearness goes by violation, then by
/// fitness; failed individuals are left out. An empty result ends the run.
template <bool upwards>
struct Threshold : Operator {
    double threshold = 0; ///< fitness; an individual with exactly this fitness does not pass
    AtLeast least;        ///< minimum number of individuals that stay
    static Words words() {
        if (upwards) return {"above", "selection", "keeps those whose fitness is above the threshold"};
        return {"below", "selection", "keeps those whose fitness is below the threshold"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.threshold, number("threshold", std::nullopt, -no_limit, no_limit, "a fitness"));
        visit(self.least.count,
              whole("at_least", 0, "if fewer pass, this number nearest to passing is taken").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_one_objective(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        return passing(population, threshold, least, upwards, context);
    }
};

/// Weights of individuals for Proportional (windowing). A weight is the distance of the fitness from the
/// worst fitness, divided by the distance of the best fitness from the worst. So any fitness is allowed, and
/// the worst individual is not chosen. If all fitnesses are equal, every weight is 1.
///
/// Failed individuals have weight 0. If at least one individual is feasible, all infeasible ones have
/// weight 0. If none is feasible, the violation of the constraints is used instead of the fitness; less is
/// better. If all individuals have failed, every weight is 1.
struct ByFitness : NoParameters {
    static constexpr const char* needs = ""; ///< members that the problem must have, for the listing

    /// The weights, one per individual, in [0, 1].
    template <Problem P>
    std::vector<double> of(const PopulationOf<P>& population, const P&) const {
        const bool any_feasible =
            std::ranges::any_of(population, [](const auto& each) { return each.fitness.feasible(); });
        std::vector<double> weights;
        for (const auto& individual : population) {
            const Fitness& f = individual.fitness;
            const bool counts = !f.has_failed() && (f.feasible() || !any_feasible);
            weights.push_back(!counts ? -HUGE_VAL : any_feasible ? f.merit() : -f.violation());
        }
        const double best = *std::max_element(weights.begin(), weights.end());
        double worst = best;
        for (const double weight : weights)
            if (weight > -HUGE_VAL) worst = std::min(worst, weight);
        for (double& weight : weights)
            weight = !(best > -HUGE_VAL)   ? 1
                     : weight == -HUGE_VAL ? 0
                     : best > worst        ? (weight - worst) / (best - worst)
                                           : 1;
        return weights;
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_one_objective(stage); }
};

/// Roulette: each place is filled by a separate random number (spin).
struct Roulette : ByFitness {
    static constexpr bool one_spin = false; ///< whether one spin fills all places
    static Words words() { return {"roulette", "selection", "chooses in proportion to the fitness above the worst"}; }
};
/// Stochastic universal sampling (Baker 1987): equally spaced marks on one spin fill all places. Every
/// individual gets its expected number of places, rounded up or down.
struct Universal : ByFitness {
    static constexpr bool one_spin = true; ///< whether one spin fills all places
    static Words words() { return {"sus", "selection", "like roulette, by equally spaced marks on one spin"}; }
};

/// Linear ranking (Baker 1985). The best individual has the weight `pressure`, and the worst has 2 -
/// pressure. Between them the weight is linear in the rank. Equal individuals have their mean weight.
struct ByRank {
    static constexpr const char* needs = ""; ///< members that the problem must have, for the listing
    static constexpr bool one_spin = false;  ///< whether one spin fills all places

    double pressure = 1.5; ///< weight of the best, above 1 and at most 2

    /// The weights, one per individual, in [0, pressure].
    template <Problem P>
    std::vector<double> of(const PopulationOf<P>& population, const P&) const {
        const std::vector<double> worth = merits(population);
        const std::vector<std::size_t> order = ranking(worth);
        const double last = static_cast<double>(order.size()) - 1;
        std::vector<double> weights(order.size(), 1);
        for (std::size_t first = 0, end; first < order.size() && last > 0; first = end) {
            for (end = first + 1; end < order.size() && worth[order[end]] == worth[order[first]];) ++end;
            const double place = static_cast<double>(first + end - 1) / 2; // ties share their places
            for (std::size_t i = first; i < end; ++i) weights[order[i]] = pressure - 2 * (pressure - 1) * place / last;
        }
        return weights;
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }
    static Words words() { return {"rank", "selection", "chooses in linear proportion to the rank"}; }
    static void describe(auto& self, auto visit) {
        visit(self.pressure, number("pressure", 1.0001, 2, "expected places of the best"));
    }
};

/// Fills the population by choosing in proportion to weights, with replacement.
template <class Weights>
struct Proportional : Operator {
    Weights weights; ///< weights: Roulette, Universal, ByRank or Sharing
    static constexpr const char* needs = Weights::needs;
    static Words words() { return Weights::words(); }
    static void describe(auto& self, auto visit) { Weights::describe(self.weights, visit); }
    void check(CheckState& known) const { weights.check(known, text_of(*this)); }

    template <Problem P>
    requires requires(const Weights& all, const PopulationOf<P>& population, const P& problem) {
        all.of(population, problem);
    }
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const std::size_t n = population.size();
        if (population.empty()) return population;
        std::vector<double> ends = weights.of(population, context.problem());
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
        // One spin puts copies of an individual side by side. Shuffled, they do not always mate with each other.
        for (std::size_t i = n; Weights::one_spin && i > 1; --i) std::swap(places[i - 1], places[spin.below(i)]);
        return context.gather(std::move(population), places);
    }
};

///@{ The operators as stages, and the argument `at_least` of `above` and `below`.
inline Best best(std::size_t n) { return checked(Best{{}, n}); }
inline Random at_random(std::size_t n = 0) { return {{}, n}; }
inline Tournament tournament(std::size_t k, std::size_t size = 0, std::string draw = "any") {
    return checked(Tournament{{}, k, size, std::move(draw)});
}
inline AtLeast at_least(std::size_t count) { return {count}; }
inline Threshold<true> above(double threshold, AtLeast least = {}) {
    return checked(Threshold<true>{{}, threshold, least});
}
inline Threshold<false> below(double threshold, AtLeast least = {}) {
    return checked(Threshold<false>{{}, threshold, least});
}
inline Proportional<Roulette> roulette() { return {}; }
inline Proportional<Universal> sus() { return {}; }
inline Proportional<ByRank> rank(double pressure = 1.5) { return checked(Proportional<ByRank>{{}, ByRank{pressure}}); }
///@}

} // namespace ga
