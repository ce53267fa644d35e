#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// So many generations were made.
struct AfterGenerations : StoppingRule {
    std::size_t n = 1; ///< >= 1

    ///@{
    /// What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() { return {"generations", "stopping", "so many were made"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("generations", "", 1, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.generation >= n;
    }
    ///@}
};

} // namespace ga
