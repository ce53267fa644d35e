#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Keeps the n best, best first. n >= 1.
struct Best : Operator {
    std::size_t n = 1; ///< how many stay, >= 1
    ///@{
    /// What every operator has (Operator).
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

} // namespace ga
