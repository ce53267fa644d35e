#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Replaces the population by n new individuals, which the problem draws at random.
struct Sample : Operator {
    std::size_t n = 1; ///< number of individuals, >= 1
    ///@{ Members that every operator has (Operator).
    static constexpr bool begins = true;
    static constexpr const char* needs = "a problem that samples genomes";
    static Words words() {
        return {"sample", "mutation", "n new individuals drawn at random in the population's place"};
    }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }
    void check(CheckState& known) const { known.scored.reset(); }

    template <Sampled P>
    PopulationOf<P> operator()(PopulationOf<P>, Context<P>& context) const {
        PopulationOf<P> fresh;
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            fresh.push_back({context.problem().sample(stream), context.new_identity(), {}, {}, {}});
            if (i == 0) {
                context.need_room(n, {}, &fresh.front().genome);
                fresh.reserve(n);
            }
        }
        return fresh;
    }
    ///@}
};

/// The stage `sample n`.
inline Sample sample(std::size_t n) { return checked(Sample{{}, n}); }

} // namespace ga
