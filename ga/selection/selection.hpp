#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Keeps the n best, best first. n >= 1.
struct Best : Operator {
    std::size_t n = 1; ///< number that stays, >= 1
    ///@{ What every operator has (Operator).
    static Words words() { return {"best", "selection", "keeps the n best, best first"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>&) const {
        return best_of(population, n);
    }
    ///@}
};

/// The stage `best n`.
inline Best best(std::size_t n) { return checked(Best{{}, n}); }

/// Keeps n different individuals at random, in random order. If there are fewer, all stay, in random order.
struct Random : Operator {
    std::size_t n = 0; ///< 0 for all
    ///@{ What every operator has (Operator).
    static Words words() { return {"random", "selection", "keeps n at random, none twice, in random order"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", "0", 0, "how many; 0 for all").quiet());
    }
    void check(CheckState&) const {}

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        Stream stream = context.stream(0);
        for (std::size_t i = 0; i + 1 < population.size(); ++i)
            std::swap(population[i], population[i + stream.below(population.size() - i)]);
        if (n > 0 && n < population.size())
            population.resize(n);
        return population;
    }
    ///@}
};

/// The stage `random n`; 0 for all, in random order.
inline Random at_random(std::size_t n = 0) { return {{}, n}; }

/// Fills each place with the best of k individuals that are drawn with replacement (Brindle 1981). The one
/// drawn first wins a tie. The best of n gets k of n places on average.
struct Tournament : Operator {
    std::size_t k = 2;    ///< individuals drawn for each place, >= 1
    std::size_t size = 0; ///< number of places; 0 for the population's size
    ///@{ What every operator has (Operator).
    static Words words() {
        return {"tournament", "selection", "each place goes to the best of k drawn at random"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.k, whole("k", "2", 1, "how many are drawn"));
        visit(self.size, whole("size", "0", 0, "places; 0 for as many as there are").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        if (population.empty())
            return population;
        context.need_room(size, population);
        const std::vector<double> worth = merits(population);
        const Below any(population.size());
        std::vector<std::size_t> winners(size > 0 ? size : population.size());
        Stream next = context.stream(0); // computed ahead, while the processor waits for the previous one
        for (std::size_t i = 0; i < winners.size(); ++i) {
            Stream stream = std::exchange(next, context.stream(i + 1));
            std::size_t winner = any(stream);
            for (std::size_t draw = 1; draw < k; ++draw)
                if (const std::size_t rival = any(stream); worth[rival] > worth[winner])
                    winner = rival;
            winners[i] = winner;
        }
        return context.gather(std::move(population), winners);
    }
    ///@}
};

/// The stage `tournament k size=size`.
inline Tournament tournament(std::size_t k, std::size_t size = 0) { return checked(Tournament{{}, k, size}); }

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
        throw NothingLeft(context.path() + ": " + counted + "; change the bound, or give at_least=K");
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
