#pragma once

#include "domain/numerics/grid.hpp"

#include <vector>

namespace rough {

/// A sampled line profile: heights Z_i at x_i = i * spacing, i = 0..N-1. Lengths in mm.
struct Profile {
    Eigen::VectorXd heights; ///< N heights, mm
    double spacing = 0;      ///< delta, mm; L/(N-1) on an open interval, L/N on a periodic one

    Index nodes() const { return heights.size(); } ///< N
};

/// The profile of these heights, `spacing` apart; mm.
inline Profile profile_of(const std::vector<double>& heights, double spacing) {
    return {Eigen::Map<const Eigen::VectorXd>(heights.data(), static_cast<Index>(heights.size())), spacing};
}

} // namespace rough
