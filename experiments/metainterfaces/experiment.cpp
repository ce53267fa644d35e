#include "apps/experiments/experiment.hpp"

#include "apps/prompt/model_settings.hpp"

namespace app {

Experiment metainterfaces_experiment() {
    std::vector<Setting> caps = cap_settings("caps.");
    for (Setting& setting : caps) setting.fallback = setting.name == "caps.asperities" ? "8x8" : "";
    return {.kind = "metainterfaces",
            .settings = joined(
                {{{"targets.files", "", "laws of area against load (CSV), separated by commas"},
                  positive("caps.modulus", "1.36", "effective modulus E*, MPa"),
                  ga::number("caps.similarity", "0.98", -1, 1, "required similarity"),
                  ga::whole("caps.nodes", "", 32, "nodes along each side of the verification [1024]").up_to(4096),
                  {"caps.accuracy", "", "relative error allowed for the model of the search"},
                  {"caps.large-laws", "", "names of the laws of the larger array"},
                  {"caps.large-asperities", "40x25", "caps of the larger array, NXxNY"},
                  {"caps.large-pipeline", "default", "pipeline for the larger array"}},
                 caps}),
            .files = {"laws.csv", "curves.csv"},
            .run = findings_of_script};
}

} // namespace app
