#pragma once

#include "domain/contact/solve.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// A contact fraction that moves smoothly with the heights, for gradients: a count of nodes has none.
///
/// Between a touching node i and its free neighbour k the edge of contact is taken to stand at the fraction
/// d/(d + e) of the way, where d = p_i/w_i is the approach since node i touched and e = gap_k/(1 - (H w)_k)
/// that until node k will, both to first order at the contact set as it is. In the mean over a node's entry
/// it is the count. On an area the edges along x and along y count half each.
struct SmoothArea {
    Eigen::VectorXd fraction;        ///< one a step
    Eigen::VectorXd by_displacement; ///< d fraction/d Delta_j with the heights fixed, 1/mm
    Eigen::MatrixXd by_height;       ///< d fraction/dZ_i with Delta_j fixed, steps x N, 1/mm
};

/// Of a solution with states. One solve on each step's contact set gives the derivatives (adjoint).
SmoothArea smooth_area(const Profile& profile, const Body& body, const ContactCurve& curve);

} // namespace rough
