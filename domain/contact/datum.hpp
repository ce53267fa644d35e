#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// The half-plane's displacement is known but for a constant, which the datum distance d fixes. Another d
/// shifts Delta by (2 P L/(pi E*)) ln(d2/d1) and changes no pressure and no area.

/// dK/d ln d = -K^2 2 L/(pi E*) at the same mean pressure, MPa/mm; `length` is L in mm, `stiffness` K in
/// MPa/mm.
double datum_sensitivity(double stiffness, double length, double effective_modulus);

/// A solved curve as it would be with another datum distance (mm), without a solve: exact, states included.
/// Throws InputError for a body without a datum, or a datum at or under (L + delta)/4.
ContactCurve with_datum(ContactCurve curve, const Profile& profile, const Body& body, double datum);

} // namespace rough
