#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// A contact fraction that changes smoothly with the heights. It has a gradient, unlike a count of nodes.
///
/// Between a touching node i and its free neighbour k the edge of contact is taken at the fraction d/(d + e)
/// of their distance. d = p_i/w_i is the displacement since node i touched. e = gap_k/(1 - (H w)_k) is the
/// displacement until node k touches. Both hold to first order at the current contact set. On average over
/// the entry of a node it equals the count. On a map, edges along x and along y count half each.
struct SmoothArea {
    Eigen::VectorXd fraction;        ///< one per load step
    Eigen::VectorXd by_displacement; ///< d fraction/d Delta_j with the heights fixed, 1/mm
    Eigen::MatrixXd by_height;       ///< d fraction/dZ_i with Delta_j fixed, steps x N, 1/mm
};

/// The smooth contact fraction of a solution with states. One solution on each step's contact set gives the
/// derivatives (adjoint).
SmoothArea smooth_area(const Profile& profile, const Body& body, const ContactCurve& curve);

} // namespace rough
