#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// So long since the block began. A run that ends so cannot be repeated bit for bit.
struct AfterSeconds : StoppingRule {
    double limit = 0; ///< s

    ///@{
    /// What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() {
        return {"seconds", "stopping", "so long; such a run cannot be repeated bit for bit"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.limit, number("seconds", "", 0, no_limit, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.seconds >= limit;
    }
    ///@}
};

} // namespace ga
