#pragma once

#include <cstdint>
#include <vector>

namespace app {

/// How often the paper's condition (10), |g1| <= sqrt(M + 2 g3), holds for random phases, with M ridges.
struct RidgeCount {
    int ridges;          ///< M
    double as_printed;   ///< share of phase sets for which it holds as the formula stands, 0..1
    double last_missing; ///< share with the last pair left out of g3 and a negative radicand read as 0
    double right_phase;  ///< share for which Eq. 8's arccos(g1/R) gives the sum's own phase
};

/// Figure 2: `sets` sets of phases, uniform over a turn, for each M >= 2.
std::vector<RidgeCount> ridge_study(const std::vector<int>& ridge_counts, int sets, std::uint64_t seed);

} // namespace app
