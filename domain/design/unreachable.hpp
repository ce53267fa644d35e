#pragma once

#include "domain/problem/setup.hpp"
#include "domain/target/out_of_reach.hpp"

namespace rough {

/// Why no profile whatever answers as a set-up asks, and how near one could come.
struct Unreachable {
    std::vector<OutOfReach> reasons; ///< none where the bound leaves room for what is wanted: no verdict then
    double bound = 1;                ///< no profile has a higher similarity
};

/// From here on what is out of reach is not worth telling, where nothing else is asked for.
constexpr double exact_enough = 0.999;

/// Of a set-up solved throughout. `wanted` is the similarity that is enough.
Unreachable unreachable(const DesignSetup& setup, double wanted = exact_enough);

/// Curves and gradients that are enough for the profile nearest to a target out of reach.
constexpr long enough_for_the_nearest = 3000;

} // namespace rough
