#pragma once

#include <Eigen/Core>

/// Rough profiles, their elastic contact and its response, and what is designed and evolved of them. Lengths
/// in mm, stresses in MPa, stiffness in MPa/mm, angles in rad.
namespace rough {

/// Counts nodes, rows and columns; signed, as Eigen counts.
using Index = Eigen::Index;

/// A sampled line profile: heights Z_i at x_i = i * spacing, i = 0..N-1. Lengths in mm.
struct Profile {
    Eigen::VectorXd heights; ///< N heights, mm
    double spacing = 0;      ///< delta, mm; L/(N-1) on an open interval, L/N on a periodic one

    Index nodes() const { return heights.size(); } ///< N
};

} // namespace rough
