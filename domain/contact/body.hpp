#pragma once

#include "domain/contact/layers.hpp"
#include "domain/numerics/grid.hpp"

#include <limits>

namespace rough {

/// Which elastic body the profile is pressed on.
enum class Kernel {
    free,     ///< non-periodic half-plane (Flamant), constant pressure on each element
    periodic, ///< periodic half-plane, nodal samples
    strip,    ///< one row of patches on a half-space (Love)
};

/// A frictionless elastic half-space; lengths in mm, modulus in MPa.
struct Body {
    Kernel kernel = Kernel::free; ///< which influence matrix
    double effective_modulus = 1; ///< E* = E/(1 - nu^2), MPa
    /// d, mm: where the free half-plane's displacement is zero (free only); 0: the profile's length L
    double datum = 0;
    double strip_width = 0; ///< W, mm (strip only); 0: L/511
    /// p_H, MPa: no node bears more; those that would are held at it and sink in. Amplitude is no free factor
    /// then, contact sets are not known to be nested, and no bound that rests on either holds.
    double hardness = std::numeric_limits<double>::infinity();
    /// Periodic only; thicknesses in mm. Whether contact sets still nest is known from contact_sets_nest.
    Layering layering = {};

    /// Whether displacements are relative to the mean plane, so that none exceeds that of full contact.
    bool relative_to_mean() const { return kernel == Kernel::periodic && !layering.carries_mean(); }
    bool yields() const { return hardness < std::numeric_limits<double>::infinity(); } ///< has a hardness
};

/// E* = E/(1 - nu^2), MPa, of Young's modulus (MPa) and Poisson's ratio.
double effective_modulus(double youngs_modulus, double poissons_ratio);

/// dK/d ln d = -K^2 2 L/(pi E*) at the same mean pressure, MPa/mm. The free half-plane's displacement is
/// known up to a constant, which the datum distance d fixes: another d shifts Delta by (2 P L/(pi E*))
/// ln(d2/d1) and changes neither pressure nor area. `length` is L in mm, `stiffness` K in MPa/mm.
double datum_sensitivity(double stiffness, double length, double effective_modulus);

/// The body with what its kernel needs and was left at 0 filled in for a profile of this length (mm).
Body completed(Body body, double length);

/// Throws InputError on a completed body that has no solution for a profile of so many nodes this far apart
/// (mm): a modulus or strip width that is not positive, a datum at or under (L + spacing)/4, layers on
/// another kernel than the periodic one or without a thickness or modulus, a rigid base without layers.
void validate(const Body& body, Index nodes, double spacing);

} // namespace rough
