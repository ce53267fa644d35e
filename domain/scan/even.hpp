#pragma once

#include "domain/profile/profile.hpp"

#include <vector>

namespace rough {

/// How far points lie from even spacing, and the even spacing nearest to them.
struct Evenness {
    double first = 0;     ///< where the fitted even nodes start, in the unit of x
    double spacing = 0;   ///< least-squares spacing, > 0
    double deviation = 0; ///< largest distance of a point from its even node, in the unit of x
    bool even = false; ///< every point is within 1e-3 spacings, or within its last written digit, of its node
};

/// Fits even nodes to x (increasing, two points or more) by least squares over the index.
/// last_digit: the value of one unit in each point's last written digit, 0 where unknown.
Evenness evenness(const std::vector<double>& x, const std::vector<double>& last_digit);

/// Heights at `nodes` even nodes from the first to the last x, linear between the points.
/// x strictly increasing, as many as heights, two or more; nodes >= 2.
Profile resampled(const std::vector<double>& x, const std::vector<double>& heights, Index nodes);

} // namespace rough
