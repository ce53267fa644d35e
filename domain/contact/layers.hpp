#pragma once

#include <vector>

namespace rough {

/// An elastic layer; it is bonded to what lies under it.
struct Layer {
    double thickness = 0;      ///< t, > 0; a finite length
    double modulus = 0;        ///< Young's modulus E, MPa; 0: the body's own
    double poissons_ratio = 0; ///< nu, above -1, up to 0.5

    auto operator<=>(const Layer&) const = default; ///< member by member
};

/// Layers, the top one first, on a half-space or on a rigid base. Periodic kernels only.
struct Layering {
    std::vector<Layer> layers = {}; ///< none: a half-space
    bool rigid_base = false;        ///< otherwise the body's own half-space
    double poissons_ratio = 0;      ///< nu of that half-space

    auto operator<=>(const Layering&) const = default; ///< member by member
    /// Whether the mean pressure alone moves the surface: the layers' thickness changes on a rigid base.
    bool carries_mean() const;
};

/// The same in other units of length and pressure (both > 0), with every modulus filled in.
Layering in_units(Layering layering, double length, double pressure);

/// u_q/p_q of the layered body over that of the half-space, 2/(E* q), for waves of the wave number q (in the
/// inverse of the layers' unit of length), q > 0: a linear system with four constants a layer and two of the
/// half-space, for given pressure and no friction at the top and bonded interfaces (Airy's stress function,
/// plane strain). On areas the same holds for q = |wave vector|. `effective_modulus` is E*, MPa.
double relative_compliance(const Layering& layering, double effective_modulus, double q);

/// E* u/P of a uniform pressure P on a rigid base: the sum of t (1 + nu) (1 - 2 nu) E*/(E (1 - nu)) over the
/// layers, in their unit of length; 0 on a half-space, whose displacement is relative to the mean.
double mean_compliance(const Layering& layering, double effective_modulus);

} // namespace rough
