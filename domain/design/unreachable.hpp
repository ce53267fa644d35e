#pragma once

#include "domain/problem/setup.hpp"
#include "domain/target/out_of_reach.hpp"

namespace rough {

/// Why no profile whatever answers as a set-up asks, and how near one could come.
struct Unreachable {
    std::vector<OutOfReach> reasons; ///< none where the bound leaves room for what is wanted: no verdict then
    double bound = 1;                ///< no profile has a higher similarity
};

/// Of a set-up solved throughout. `wanted` is the similarity that is enough; without one 0.999 is.
Unreachable unreachable(const DesignSetup& setup, std::optional<double> wanted = {});

/// Curves and gradients that are enough for the profile nearest to a target out of reach.
constexpr long enough_for_the_nearest = 3000;

} // namespace rough
