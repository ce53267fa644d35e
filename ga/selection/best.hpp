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

} // namespace ga
