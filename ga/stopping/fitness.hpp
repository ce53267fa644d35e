#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// The best of the population that holds its constraints reaches a fitness, as its objective states it.
struct AtFitness : StoppingRule {
    double value = 0; ///< of the objective

    ///@{
    /// What every rule has (StoppingRule).
    static Words words() { return {"fitness", "stopping", "the best reaches it"}; }
    static void describe(auto& self, auto visit) {
        visit(self.value, number("fitness", "", -no_limit, no_limit, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_one_objective(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return std::any_of(now.population.begin(), now.population.end(), [&](const auto& individual) {
            const Fitness& f = individual.fitness;
            return f.known() && !f.has_failed() && f.feasible() &&
                   (f.minimises() ? f.value() <= value : f.value() >= value);
        });
    }
    ///@}
};

} // namespace ga
