#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Keeps n individuals chosen at random, none twice, in random order; all of them, shuffled, where there are
/// no more.
struct Random : Operator {
    std::size_t n = 0; ///< 0 for all
    ///@{
    /// What every operator has (Operator).
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

/// The stage `random n`; 0 for all of them, shuffled.
inline Random at_random(std::size_t n = 0) { return {{}, n}; }

} // namespace ga
