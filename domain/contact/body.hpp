#pragma once

#include "domain/contact/layers.hpp"
#include "domain/numerics/grid.hpp"

#include <limits>
#include <string>
#include <vector>

namespace rough {

/// Which elastic body the profile is pressed on.
enum class Kernel {
    free,     ///< non-periodic half-plane (Flamant), constant pressure on each element
    periodic, ///< periodic half-plane, nodal samples
    strip,    ///< one row of patches on a half-space (Love)
};

const std::vector<std::string>& kernel_names(); ///< in the order of Kernel
const std::string& name_of(Kernel kernel);      ///< free, periodic or strip
/// The kernel of that name. Throws InputError that begins with `where` for another word.
Kernel kernel_named(const std::string& name, const std::string& where = "kernel");

/// A frictionless elastic half-space; lengths in mm, modulus in MPa.
struct Body {
    Kernel kernel = Kernel::free; ///< which influence matrix
    double effective_modulus = 1; ///< E* = E/(1 - nu^2), MPa
    /// d, mm: the distance at which the free half-plane's displacement is zero (free only); 0: L
    double datum = 0;
    double strip_width = 0; ///< W, mm (strip only); 0: L/511
    /// p_H, MPa: the highest pressure that a node carries. Nodes that would carry more are held at it and
    /// sink in. The amplitude then changes more than a scale, contact sets are not known to be nested, and no
    /// bound that depends on either holds.
    double hardness = std::numeric_limits<double>::infinity();
    /// Periodic only; thicknesses in mm. contact_sets_nest tells whether contact sets still nest.
    Layering layering = {};

    /// Whether displacements are relative to the mean plane, so that full contact has the largest one.
    bool relative_to_mean() const { return kernel == Kernel::periodic && !layering.carries_mean(); }
    bool yields() const { return hardness < std::numeric_limits<double>::infinity(); } ///< has a hardness
};

/// E* = E/(1 - nu^2), MPa, of Young's modulus (MPa) and Poisson's ratio.
double effective_modulus(double youngs_modulus, double poissons_ratio);

/// dK/d ln d = -K^2 2 L/(pi E*) at the same mean pressure, MPa/mm. The free half-plane's displacement is
/// known up to a constant, which the datum distance d fixes. Another d shifts Delta by (2 P L/(pi E*))
/// ln(d2/d1) and changes neither pressure nor area. `length` is L in mm, `stiffness` K in MPa/mm.
double datum_sensitivity(double stiffness, double length, double effective_modulus);

/// The body with the defaults of its kernel in place of zeros, for a profile of this length (mm).
Body completed(Body body, double length);

/// Throws InputError if a completed body has no solution for a profile of `nodes` nodes, `spacing` mm apart.
/// The reasons are a modulus or strip width that is not positive, and a datum up to (L + spacing)/4. Others
/// are layers on another kernel than the periodic one, layers without a thickness or modulus, and a rigid
/// base without layers.
void validate(const Body& body, Index nodes, double spacing);

} // namespace rough
