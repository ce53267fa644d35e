#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Brings back the k best of the generation's start; as many of the worst go, so that the size stays. An
/// individual that is there still is not doubled, and none that is better is lost for one that is worse.
/// Under several objectives all of them are ranked together first.
struct Elite : Operator {
    std::size_t k = 1; ///< how many come back, >= 1
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"elite", "replacement", "brings back the k best of the generation's start for the worst"};
    }
    static void describe(auto& self, auto visit) { visit(self.k, whole("k", "1", 1, "how many")); }
    std::size_t reads_of_start() const { return k; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto& start = context.generation_start();
        std::vector<double> worth = merits(population, start);
        const auto first_of_start = static_cast<std::ptrdiff_t>(population.size());
        for (std::size_t i = 0; i < std::min(k, start.size()); ++i) {
            const auto& old = start[i];
            const auto same = [&](const auto& each) { return each.identity == old.identity; };
            if (std::any_of(population.begin(), population.end(), same))
                continue;
            const auto worst = std::min_element(worth.begin(), worth.begin() + first_of_start);
            const double own = worth[population.size() + i];
            if (*worst < own) {
                *worst = own;
                population[static_cast<std::size_t>(worst - worth.begin())] = old;
            }
        }
        return population;
    }
    ///@}
};

/// The stage `elite k`.
inline Elite elite(std::size_t k) { return checked(Elite{{}, k}); }

} // namespace ga
