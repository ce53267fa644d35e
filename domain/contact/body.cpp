#include "domain/contact/body.hpp"

#include "domain/errors.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rough {

const std::vector<std::string>& kernel_names() {
    static const std::vector<std::string> names{"free", "periodic", "strip"};
    return names;
}

const std::string& name_of(Kernel kernel) { return kernel_names()[static_cast<std::size_t>(kernel)]; }

Kernel kernel_named(const std::string& name, const std::string& where) {
    const auto& names = kernel_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError(where + ": '" + name + "' is unknown; choose free, periodic or strip");
    return static_cast<Kernel>(found - names.begin());
}

double effective_modulus(double youngs_modulus, double poissons_ratio) {
    return youngs_modulus / (1 - poissons_ratio * poissons_ratio);
}

double datum_sensitivity(double stiffness, double length, double effective_modulus) {
    return -stiffness * stiffness * (2 * length / (std::numbers::pi * effective_modulus));
}

Body completed(Body body, double length) {
    if (body.kernel == Kernel::free) body.datum = body.datum.value_or(length);
    if (body.kernel == Kernel::strip) body.strip_width = body.strip_width.value_or(length / 511);
    return body;
}

void validate(const Body& body, Index nodes, double spacing) {
    const auto expect_positive = [](const char* what, double value, const char* unit, const char* quantity) {
        if (!(value > 0 && std::isfinite(value)))
            refuse_value(what, value, unit, " is out of range (a positive finite ", quantity, ")");
    };
    expect_positive("modulus", body.effective_modulus, " MPa", "effective modulus");
    if (!(body.hardness > 0)) refuse_value("hardness", body.hardness, " MPa is out of range (above 0)");
    const double limit = spacing * static_cast<double>(nodes) / 4;
    const double datum = body.datum.value_or(0);
    if (body.kernel == Kernel::free && !(datum > limit && std::isfinite(datum)))
        refuse_value("datum", datum, " mm is out of range (above ", limit,
                     " mm, (L + spacing)/4, for a unique solution of the free half-plane)");
    if (body.kernel == Kernel::strip) expect_positive("strip width", body.strip_width.value_or(0), " mm", "length");
    const Layering& layering = body.layering;
    if (!layering.layers.empty() && body.kernel != Kernel::periodic)
        throw InputError("layers need a periodic body; choose --kernel periodic", "layer");
    if (layering.rigid_base && layering.layers.empty())
        throw InputError("a rigid base needs layers; add --layer THICKNESS", "base");
    for (const Layer& layer : layering.layers) {
        expect_positive("layer", layer.thickness, " mm", "thickness");
        expect_positive("layer", layer.modulus, " MPa", "modulus");
        if (!(layer.poissons_ratio > -1 && layer.poissons_ratio <= 0.5))
            refuse_value("layer", "Poisson's ratio ", layer.poissons_ratio, " is out of range (above -1, up to 0.5)");
    }
}

namespace {

/// The stress function's amplitude G(s), s = q z with z into the body, and its first three derivatives.
template <class Real>
using Derivatives = std::array<Real, 4>;

/// The derivatives of (1, s) e^(-s) at s, which decay into the body. If `up`, those of the same functions of
/// h - s, which decay towards its top; s then stands for h - s.
template <class Real>
std::array<Derivatives<Real>, 2> decaying(Real s, bool up) {
    const Real e = std::exp(-s), sign = up ? -1 : 1;
    return {{{e, -sign * e, e, -sign * e}, {s * e, sign * (1 - s) * e, (s - 2) * e, sign * (3 - s) * e}}};
}

/// Normal and shear stress, and displacement along and across the surface times q and a modulus: the four
/// that are continuous. `softness` is (1 + nu)/E in units of that modulus.
template <class Real>
Eigen::Matrix<Real, 4, 1> state(const Derivatives<Real>& g, Real nu, Real softness) {
    return {-g[0], g[1], softness * ((1 - nu) * g[2] + nu * g[0]), softness * ((1 - nu) * g[3] + (nu - 2) * g[1])};
}

/// Displacement of the top under a unit traction, times q and the modulus. A linear system gives it, with
/// four constants per layer and two for the half-space (Airy's stress function, plane strain).
template <class Real>
Real top_displacement(const Layering& layering, double modulus, double q, Traction traction) {
    using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
    const auto layers = static_cast<Eigen::Index>(layering.layers.size());
    const Eigen::Index unknowns = 4 * layers + (layering.rigid_base ? 0 : 2);
    Matrix system = Matrix::Zero(unknowns, unknowns);
    Eigen::Matrix<Real, Eigen::Dynamic, 1> given = Matrix::Zero(unknowns, 1);
    Eigen::Matrix<Real, 4, 4> top, first_top;
    for (Eigen::Index k = 0; k < layers; ++k) {
        const Layer& layer = layering.layers[static_cast<std::size_t>(k)];
        const Real nu = layer.poissons_ratio, softness = (1 + nu) * modulus / layer.modulus, h = q * layer.thickness;
        Eigen::Matrix<Real, 4, 4> bottom;
        for (Eigen::Index c = 0; c < 4; ++c) {
            const auto which = static_cast<std::size_t>(c % 2);
            top.col(c) = state(decaying(c < 2 ? Real(0) : h, c >= 2)[which], nu, softness);
            bottom.col(c) = state(decaying(c < 2 ? h : Real(0), c >= 2)[which], nu, softness);
        }
        if (k == 0) {
            first_top = top;
            system.topLeftCorner(2, 4) = top.topRows(2);
            given[traction == Traction::normal ? 0 : 1] = -1;
        } else {
            system.block(4 * k - 2, 4 * k, 4, 4) = -top;
        }
        if (k + 1 < layers || !layering.rigid_base)
            system.block(4 * k + 2, 4 * k, 4, 4) = bottom;
        else
            system.block(4 * k + 2, 4 * k, 2, 4) = bottom.bottomRows(2);
    }
    if (!layering.rigid_base) {
        const Real nu = layering.poissons_ratio;
        for (Eigen::Index c = 0; c < 2; ++c)
            system.col(4 * layers + c).tail(4) =
                -state(decaying(Real(0), false)[static_cast<std::size_t>(c)], nu, 1 + nu);
    }
    const Eigen::Matrix<Real, Eigen::Dynamic, 1> constants = system.partialPivLu().solve(given);
    return (first_top * constants.template head<4>())[traction == Traction::normal ? 3 : 2];
}

} // namespace

bool Layering::carries_mean(Traction traction) const { return mean_compliance(*this, 1, traction) > 0; }

Layering in_units(Layering layering, double length, double pressure) {
    for (Layer& layer : layering.layers) {
        layer.thickness /= length;
        layer.modulus /= pressure;
    }
    return layering;
}

double relative_compliance(const Layering& layering, double effective_modulus, double q, Traction traction) {
    if (layering.layers.empty()) return 1;
    constexpr double deep = 40;  // e^-40 is negligible against 1
    constexpr double thin = 0.1; // the four functions of a thin layer are nearly the same
    Layering seen = layering;    // down to the depth that the wave reaches
    double depth = 0;
    for (std::size_t k = 0; k < seen.layers.size(); ++k)
        if ((depth += q * seen.layers[k].thickness) > deep) {
            seen.layers.resize(k + 1);
            seen.layers[k].thickness = std::min(seen.layers[k].thickness, deep / q);
        }
    const bool is_thin = std::any_of(seen.layers.begin(), seen.layers.end(),
                                     [&](const Layer& layer) { return q * layer.thickness < thin; });
    const double modulus = effective_modulus * (1 - layering.poissons_ratio * layering.poissons_ratio),
                 displacement = is_thin ? static_cast<double>(top_displacement<long double>(seen, modulus, q, traction))
                                        : top_displacement<double>(seen, modulus, q, traction);
    return displacement / modulus * effective_modulus / 2;
}

double mean_compliance(const Layering& layering, double effective_modulus, Traction traction) {
    double sum = 0;
    if (layering.rigid_base)
        for (const Layer& layer : layering.layers) {
            const double nu = layer.poissons_ratio;
            const double share = traction == Traction::normal ? (1 - 2 * nu) / (1 - nu) : 2;
            sum += layer.thickness * (1 + nu) * share * effective_modulus / layer.modulus;
        }
    return sum;
}

} // namespace rough
