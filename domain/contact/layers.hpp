#pragma once

#include <vector>

namespace rough {

/// An elastic layer, bonded to the layer or base under it.
struct Layer {
    double thickness = 0;      ///< t, > 0; a finite length
    double modulus = 0;        ///< Young's modulus E, MPa; 0: that of the body
    double poissons_ratio = 0; ///< nu, above -1, up to 0.5

    auto operator<=>(const Layer&) const = default; ///< member by member
};

/// Layers, the top one first, on a half-space or on a rigid base. Periodic kernels only.
struct Layering {
    std::vector<Layer> layers = {}; ///< none: a half-space
    bool rigid_base = false;        ///< otherwise the body's half-space
    double poissons_ratio = 0;      ///< nu of that half-space

    auto operator<=>(const Layering&) const = default; ///< member by member
    /// Whether the mean pressure alone moves the surface: the layers' thickness changes on a rigid base.
    bool carries_mean() const;
};

/// The layers in other units of length and pressure (both > 0), with every modulus given.
Layering in_units(Layering layering, double length, double pressure);

/// u_q/p_q of the layered body over that of the half-space, 2/(E* q). The wavenumber q > 0 is in the inverse
/// of the layers' unit of length; on a map it is |wave vector|. A linear system gives the ratio, with four
/// constants per layer and two for the half-space (Airy's stress function, plane strain). The top has a given
/// pressure and no friction; interfaces are bonded. `effective_modulus` is E*, MPa.
double relative_compliance(const Layering& layering, double effective_modulus, double q);

/// E* u/P of a uniform pressure P, in the layers' unit of length. On a rigid base it is the sum over the
/// layers of t (1 + nu) (1 - 2 nu) E*/(E (1 - nu)). It is 0 on a half-space, whose displacement is relative
/// to the mean.
double mean_compliance(const Layering& layering, double effective_modulus);

} // namespace rough
