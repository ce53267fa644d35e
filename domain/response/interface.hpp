#pragma once

#include "domain/response/curve.hpp"

namespace rough {

/// Interface stiffness K_i (Barber 2003): 1/K_i = 1/K - 1/K_full, without the half-plane in series with the
/// contact. In plane strain K_i does not depend on the datum, because another datum adds the same constant to
/// 1/K for every contact set. This holds for secants too. On a periodic half-plane K_i = K.

/// K_i of the tangent at each load step, MPa/mm; infinite at full contact.
Eigen::VectorXd interface_stiffness(const Response& response);

/// K_i of one stiffness K, both MPa/mm. If K is within a relative 1e-12 of K_full, K_i is 1e12 K.
double interface_of(double stiffness, double full_stiffness);
/// The derivatives of K_i from those of `stiffness`; zero if K_i is 1e12 K.
CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness);

/// K_i against mean pressure for similarities: of the secants of secant_stiffness().
Curve interface_secants(const Response& response);

} // namespace rough
