#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Gives each individual the mean fitness of n replicates of a noisy evaluation, in place of `score`: the
/// elite then keeps good means and not lucky draws. Replicates that are known are not evaluated again, so
/// that a larger n later pays for the difference only.
struct Average : Operator {
    std::size_t n = 2;     ///< replicates
    std::string objective; ///< empty: the problem's first

    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"average", "selection", "the mean fitness of n replicates of a noisy evaluation"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", std::nullopt, 1, "replicates").up_to(1e6));
        visit(self.objective, word("objective", "", "one of the problem's; its first where none is given"));
    }
    void check(CheckState& known) const { known.scored = known.objective(text_of(*this), objective); }

    template <Noisy P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        context.average(population, objective, n);
        return population;
    }
    ///@}
};

/// The stage `average n objective`.
inline Average average(std::size_t n, std::string objective = {}) {
    return checked(Average{{}, n, std::move(objective)});
}

} // namespace ga
