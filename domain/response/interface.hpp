#pragma once

#include "domain/response/curve.hpp"

namespace rough {

/// The interface's own stiffness K_i (Barber 2003): 1/K_i = 1/K - 1/K_full takes the half-plane that is in
/// series with the contact out of K. In plane strain this frees it from the datum: another one adds the same
/// to 1/K for every contact set, so also to a secant's. On a periodic half-plane K_i = K.

/// K_i of each load step's tangent, MPa/mm; infinite at full contact.
Eigen::VectorXd interface_stiffness(const Response& response);

/// K_i of one stiffness K, both MPa/mm. A stiffness within 1e-12 of K_full is rounding next to full contact:
/// there K_i is 1e12 K.
double interface_of(double stiffness, double full_stiffness);
/// The same of the derivatives of `stiffness`; zero where K_i is 1e12 K.
CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness);

/// K_i against mean pressure as it is scored: of the secants, where secant_stiffness() has them.
Curve interface_secants(const Response& response);

} // namespace rough
