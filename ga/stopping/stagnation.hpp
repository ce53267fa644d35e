#pragma once

#include "ga/stopping/rule.hpp"

namespace ga {

/// So many generations since the population last became better than it had been (`improves`).
struct AtStagnation : StoppingRule {
    std::size_t n = 1; ///< >= 1

    ///@{
    /// What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() { return {"stagnation", "stopping", "so many generations without a better best"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("stagnation", "", 1, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers& memory) const {
        improves(now, memory);
        return static_cast<double>(now.generation) - memory[2] >= static_cast<double>(n);
    }
    ///@}
};

} // namespace ga
