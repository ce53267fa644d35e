#include "domain/response/model.hpp"

#include <cstdio>

namespace rough {

std::string field_text(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    return digits;
}

Fields fields(const Model& given) {
    const Model model = completed(given);
    const Body& body = model.body;
    Fields all{{"nodes", std::to_string(model.grid.nodes)},
               {"length_mm", field_text(model.grid.length)},
               {"kernel", name_of(body.kernel)},
               {"effective_modulus_MPa", field_text(body.effective_modulus)},
               {"steps", std::to_string(model.loading.steps)},
               {"reach", field_text(model.loading.reach)}};
    if (model.grid.is_2d()) {
        all.emplace_back("rows", std::to_string(model.grid.rows));
        all.emplace_back("width_mm", field_text(model.grid.width));
    }
    if (body.kernel == Kernel::free && !model.grid.is_2d())
        all.emplace_back("datum_mm", field_text(body.datum));
    if (body.kernel == Kernel::strip)
        all.emplace_back("strip_width_mm", field_text(body.strip_width));
    if (!body.layering.layers.empty()) {
        std::string layers;
        for (const Layer& layer : body.layering.layers)
            layers += field_text(layer.thickness) + ":" + field_text(layer.modulus) + ":" +
                      field_text(layer.poissons_ratio) + " ";
        all.emplace_back("layers", layers + (body.layering.rigid_base ? "rigid" : "elastic"));
    }
    return all;
}

} // namespace rough
