#pragma once

#include "domain/numerics/grid.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rough {

/// The direction of a traction on the surface and of the displacement that it causes. Tangential is along the
/// line. Both are taken as uncoupled: a traction does not displace across its direction.
enum class Traction { normal, tangential };

/// An elastic layer, bonded to the layer or base under it.
struct Layer {
    double thickness = 0;      ///< t, mm, > 0 and finite
    double modulus = 0;        ///< Young's modulus E, MPa
    double poissons_ratio = 0; ///< Poisson's ratio nu, above -1, up to 0.5

    auto operator<=>(const Layer&) const = default; ///< member by member
};

/// Layers, the top one first, on a half-space or on a rigid base. Only the periodic kernel has layers.
struct Layering {
    std::vector<Layer> layers = {}; ///< if empty, the body is a half-space
    bool rigid_base = false;        ///< whether the base is rigid; otherwise it is the body's half-space
    double poissons_ratio = 0;      ///< nu of the half-space

    auto operator<=>(const Layering&) const = default; ///< member by member
    /// Whether a uniform traction moves the surface. A pressure does if the base is rigid and a layer
    /// compressible, a tangential traction if the base is rigid.
    bool carries_mean(Traction traction = Traction::normal) const;
};

/// The layers with thicknesses divided by `length` and moduli by `pressure` (both > 0).
Layering in_units(Layering layering, double length, double pressure);

/// The compliance u_q/p_q of the layered body, divided by the half-space's compliance 2/(E* q), at the
/// wavenumber q > 0 (README.md). q is in the inverse of the layers' unit of length; on a map it is the length
/// of the wave vector. `effective_modulus` is E*, MPa. For a tangential traction u_q is along the line.
double relative_compliance(const Layering& layering, double effective_modulus, double q,
                           Traction traction = Traction::normal);

/// The mean compliance E* u/P, in the layers' unit of length: u is the displacement under a uniform traction
/// P on a rigid base (README.md). It is 0 on a half-space, whose displacement is relative to the mean.
double mean_compliance(const Layering& layering, double effective_modulus, Traction traction = Traction::normal);

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
    Kernel kernel = Kernel::free;           ///< type of body, which determines the influence matrix
    double effective_modulus = 1;           ///< E* = E/(1 - nu^2), MPa
    std::optional<double> datum = {};       ///< datum d, mm (free only; README.md). Default: L
    std::optional<double> strip_width = {}; ///< width W, mm (strip only). Default: L/511
    /// Hardness p_H, MPa: the highest pressure of a node. Nodes that would carry more are held at it and sink
    /// in (README.md).
    double hardness = std::numeric_limits<double>::infinity();
    /// Layers (periodic only), thicknesses in mm. contact_sets_nest() tells whether contact sets only grow.
    Layering layering = {};

    /// Whether displacements are relative to the mean plane. Then full contact has the largest displacement.
    bool relative_to_mean() const { return kernel == Kernel::periodic && !layering.carries_mean(); }
    bool yields() const { return hardness < std::numeric_limits<double>::infinity(); } ///< has a hardness
};

/// E* = E/(1 - nu^2), MPa, of Young's modulus (MPa) and Poisson's ratio.
double effective_modulus(double youngs_modulus, double poissons_ratio);

/// The derivative of the stiffness K with respect to ln d, d the datum, at the same mean pressure: -K^2 2
/// L/(pi E*), MPa/mm (README.md). `length` is L in mm, `stiffness` K in MPa/mm.
double datum_sensitivity(double stiffness, double length, double effective_modulus);

/// The body with the defaults of its kernel for a profile of this length (mm).
Body completed(Body body, double length);

/// Throws InputError if a completed body has no solution for a profile of `nodes` nodes, `spacing` mm apart.
/// Reasons are values out of range, also a datum up to (L + spacing)/4. Others are layers on a kernel other
/// than the periodic one, and a rigid base without layers.
void validate(const Body& body, Index nodes, double spacing);

} // namespace rough
