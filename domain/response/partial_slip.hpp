#pragma once

#include "domain/response/response.hpp"

namespace rough {

/// Partial slip (Ciavarella 1998, Jaeger 1998). Under a constant normal load P and a growing tangential load
/// Q, nodes slip from the edges of contact inwards. The nodes that stick are those that touch under a smaller
/// normal load P*.
///
///     Q = f [P - P*],   tangential displacement = f [Delta - Delta*]
///
/// So the curve follows from the normal curve, exactly at its load steps. Assumptions: plane strain, Coulomb
/// friction with one coefficient f, elastic contact. The bodies do not couple: they are equal, or Dundurs'
/// beta is 0 (a rigid profile: nu = 0.5). Displacements have the datum of the normal ones.

/// A tangential load-displacement curve, from stick (Q = 0) to full slip (Q = f P). It has one row more than
/// the load steps; row k has P* = P_(n-k), the last row P* = 0.
struct PartialSlip {
    Eigen::VectorXd displacement;   ///< tangential, mm
    Eigen::VectorXd traction;       ///< Q as a mean over the length, MPa
    Eigen::VectorXd stiffness;      ///< dQ/d displacement, MPa/mm; 0 at full slip
    Eigen::VectorXd stick_fraction; ///< share of the touching nodes that stick
};

/// The curve under the response's last normal load. Throws InputError if the friction coefficient is not
/// positive and finite, or nodes are at the hardness.
PartialSlip partial_slip(const Response& response, double friction);

} // namespace rough
