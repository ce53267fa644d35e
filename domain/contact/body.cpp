#include "domain/contact/body.hpp"

#include "domain/errors.hpp"

#include <cmath>

namespace rough {

namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

} // namespace

double effective_modulus(double youngs_modulus, double poissons_ratio) {
    return youngs_modulus / (1 - poissons_ratio * poissons_ratio);
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
    if (!is_positive(body.effective_modulus))
        refuse_value("modulus", body.effective_modulus,
                     " MPa given as the effective one, expected a positive finite number");
    if (!(body.hardness > 0))
        refuse_value("hardness", body.hardness, " MPa given, expected a positive pressure");
    const double limit = spacing * static_cast<double>(nodes) / 4;
    if (body.kernel == Kernel::free && !(body.datum > limit && std::isfinite(body.datum)))
        refuse_value("datum", body.datum, " mm given, expected more than ", limit,
                     " mm, (L + spacing)/4: nearer, the free half-plane has no unique solution");
    if (body.kernel == Kernel::strip && !is_positive(body.strip_width))
        refuse_value("strip width", body.strip_width, " mm given, expected a positive finite length");
    const Layering& layering = body.layering;
    if (!layering.layers.empty() && body.kernel != Kernel::periodic)
        throw InputError("given on a body that is not periodic, expected --kernel periodic", "layer");
    if (layering.rigid_base && layering.layers.empty())
        throw InputError("rigid given without layers, expected --layer THICKNESS", "base");
    for (const Layer& layer : layering.layers) {
        if (!is_positive(layer.thickness))
            refuse_value("layer", layer.thickness, " mm given, expected a positive finite thickness");
        if (!is_positive(layer.modulus))
            refuse_value("layer", layer.modulus, " MPa given as modulus, expected a positive finite number");
        if (!(layer.poissons_ratio > -1 && layer.poissons_ratio <= 0.5))
            refuse_value("layer", layer.poissons_ratio,
                         " given as Poisson's ratio, expected more than -1 and at most 0.5");
    }
}

} // namespace rough
