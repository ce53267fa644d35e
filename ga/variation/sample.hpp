#pragma once

#include "ga/stage.hpp"

namespace ga {

/// Puts n new individuals drawn at random by the problem in the place of the population.
struct Sample : Operator {
    std::size_t n; ///< how many, >= 1

    /// Throws UsageError on 0.
    explicit Sample(std::size_t count) : n(count) {
        if (n == 0)
            throw UsageError("sample 0 draws nobody; expected at least 1");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "sample " + std::to_string(n); }
    void check(Known& known) const { known.scored.reset(); }

    template <Problem P>
    requires Sampled<P> Population<typename P::Genome>
    operator()(Population<typename P::Genome>, Context<P>& context) const {
        Population<typename P::Genome> fresh(n);
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            fresh[i].genome = context.problem().sample(stream);
            fresh[i].identity = context.new_identity();
        }
        return fresh;
    }
    ///@}
};

/// The stage `sample n`.
inline Sample sample(std::size_t n) { return Sample(n); }

} // namespace ga
