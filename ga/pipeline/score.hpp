#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Evaluates what has no fitness under the objective. One outcome serves all objectives; known genomes cost
/// nothing.
struct Score : Operator {
    std::string objective; ///< empty: the problem's first

    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"score", "selection", "evaluates what has no fitness under the objective"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.objective, word("objective", "", "one of the problem's; its first where none is given"));
    }
    void check(CheckState& known) const { known.scored = known.objective(text_of(*this), objective); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        context.score(population, objective);
        return population;
    }
    ///@}
};

/// The stage `score objective`; without a name the problem's first.
inline Score score(std::string objective = {}) { return {{}, std::move(objective)}; }
/// The stage `score objective`.
template <class Outcome>
Score score(const Objective<Outcome>& objective) {
    return score(objective.name);
}

} // namespace ga
