#pragma once

#include "domain/response/response.hpp"

namespace rough {

/// Partial slip after Ciavarella (1998) and Jaeger (1998): under a constant normal load P a growing
/// tangential one Q lets nodes slip from the edges of contact inwards, those stick that touch at a lesser
/// normal load P*,
///
///     Q = f [P - P*],   tangential displacement = f [Delta - Delta*],
///
/// so that the whole curve is the normal one read backwards, exact at its load steps. Assumed: Coulomb
/// friction with one coefficient f; plane strain; bodies that do not couple (equal ones, or Dundurs' beta =
/// 0; a rigid profile on an elastic body at nu = 0.5 only); no hardness. Displacements share the normal one's
/// datum.

/// A tangential load-displacement curve, from stick (Q = 0) to full slip (Q = f P): one row more than there
/// are load steps; row k has P* = P_(n-k), the last one P* = 0.
struct PartialSlip {
    Eigen::VectorXd displacement;   ///< tangential, mm
    Eigen::VectorXd traction;       ///< Q as a mean over the length, MPa
    Eigen::VectorXd stiffness;      ///< dQ/d displacement, MPa/mm; 0 at full slip
    Eigen::VectorXd stick_fraction; ///< of the nodes that touch, how many stick
};

/// Under the response's last normal load. Throws InputError on a friction coefficient that is not positive
/// and finite, or nodes held at a hardness.
PartialSlip partial_slip(const Response& response, double friction);

} // namespace rough
