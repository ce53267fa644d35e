#include "domain/contact/body.hpp"

#include "domain/errors.hpp"

#include <algorithm>
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
    if (found == names.end())
        throw InputError(where + ": '" + name + "' is unknown; choose free, periodic or strip");
    return static_cast<Kernel>(found - names.begin());
}

double effective_modulus(double youngs_modulus, double poissons_ratio) {
    return youngs_modulus / (1 - poissons_ratio * poissons_ratio);
}

double datum_sensitivity(double stiffness, double length, double effective_modulus) {
    return -stiffness * stiffness * (2 * length / (std::numbers::pi * effective_modulus));
}

Body completed(Body body, double length) {
    if (body.kernel == Kernel::free && body.datum == 0)
        body.datum = length;
    if (body.kernel == Kernel::strip && body.strip_width == 0)
        body.strip_width = length / 511;
    for (Layer& layer : body.layering.layers)
        if (layer.modulus == 0) {
            layer.poissons_ratio = body.layering.poissons_ratio;
            layer.modulus = body.effective_modulus * (1 - layer.poissons_ratio * layer.poissons_ratio);
        }
    return body;
}

void validate(const Body& body, Index nodes, double spacing) {
    const auto expect_positive = [](const char* what, double value, const char* unit, const char* quantity) {
        if (!(value > 0 && std::isfinite(value)))
            refuse_value(what, value, unit, " is out of range (a positive finite ", quantity, ")");
    };
    expect_positive("modulus", body.effective_modulus, " MPa", "effective modulus");
    if (!(body.hardness > 0))
        refuse_value("hardness", body.hardness, " MPa is out of range (above 0)");
    const double limit = spacing * static_cast<double>(nodes) / 4;
    if (body.kernel == Kernel::free && !(body.datum > limit && std::isfinite(body.datum)))
        refuse_value("datum", body.datum, " mm is out of range (above ", limit,
                     " mm, (L + spacing)/4, for a unique solution of the free half-plane)");
    if (body.kernel == Kernel::strip)
        expect_positive("strip width", body.strip_width, " mm", "length");
    const Layering& layering = body.layering;
    if (!layering.layers.empty() && body.kernel != Kernel::periodic)
        throw InputError("layers need a periodic body; choose --kernel periodic", "layer");
    if (layering.rigid_base && layering.layers.empty())
        throw InputError("a rigid base needs layers; add --layer THICKNESS", "base");
    for (const Layer& layer : layering.layers) {
        expect_positive("layer", layer.thickness, " mm", "thickness");
        expect_positive("layer", layer.modulus, " MPa", "modulus");
        if (!(layer.poissons_ratio > -1 && layer.poissons_ratio <= 0.5))
            refuse_value("layer", "Poisson's ratio ", layer.poissons_ratio,
                         " is out of range (above -1, up to 0.5)");
    }
}

} // namespace rough
