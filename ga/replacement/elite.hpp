#pragma once

#include "ga/selection/best.hpp"

namespace ga {

/// Brings back the k best of the generation's start; as many of the worst go, so that the size stays. An
/// individual that is there still is not doubled, and none that is better is lost for one that is worse.
struct Elite : Operator {
    std::size_t k; ///< how many come back, >= 1

    /// Throws UsageError on 0.
    explicit Elite(std::size_t count) : k(count) {
        if (k == 0)
            throw UsageError("elite 0 keeps nobody; expected at least 1");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "elite " + std::to_string(k); }
    std::size_t reads_of_start() const { return k; }
    void check(Known& known) const {
        known.need_generation(text());
        known.need_score(text());
    }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        const auto& start = context.generation_start();
        for (std::size_t i = 0; i < std::min(k, start.size()); ++i) {
            const auto& old = start[i];
            const auto same = [&](const auto& each) { return each.identity == old.identity; };
            if (std::any_of(population.begin(), population.end(), same))
                continue;
            const auto worst =
                std::min_element(population.begin(), population.end(),
                                 [](const auto& a, const auto& b) { return a.value() < b.value(); });
            if (worst->value() < old.value())
                *worst = old;
        }
        return population;
    }
    ///@}
};

/// The stage `elite k`.
inline Elite elite(std::size_t k) { return Elite(k); }

} // namespace ga
