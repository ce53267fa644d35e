#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// The population has converged: all of it holds its constraints, and the best and the worst value of every
/// objective are no further apart than this (the tolerance on f of libpagmo's and NLopt's searches).
struct AtConvergence : StoppingRule {
    double most = 0; ///< in the objective's units, >= 0

    ///@{
    /// What every rule has (StoppingRule).
    static Words words() { return {"converged", "stopping", "best and worst are no further apart"}; }
    static void describe(auto& self, auto visit) {
        visit(self.most, number("converged", "", 0, no_limit, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        Point least, greatest;
        for (const auto& individual : now.population) {
            const Fitness& fitness = individual.fitness;
            if (!fitness.known() || fitness.has_failed() || !fitness.feasible())
                return false;
            const Point values = fitness.several() ? fitness.values() : Point{fitness.merit()};
            if (least.empty())
                least = greatest = values;
            for (std::size_t k = 0; k < values.size(); ++k) {
                least[k] = std::min(least[k], values[k]);
                greatest[k] = std::max(greatest[k], values[k]);
                if (greatest[k] - least[k] > most)
                    return false;
            }
        }
        return true;
    }
    ///@}
};

} // namespace ga
