#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// So many evaluations were asked for since the block began, whether they were paid or remembered.
struct AfterEvaluations : StoppingRule {
    long n = 1; ///< >= 1

    ///@{
    /// What every rule has (StoppingRule).
    static Words words() { return {"evaluations", "stopping", "so many were asked for"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("evaluations", "", 1, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.asked >= n;
    }
    ///@}
};

} // namespace ga
