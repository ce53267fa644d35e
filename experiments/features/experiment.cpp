#include "apps/experiments/script.hpp"
#include "apps/prompt/model_settings.hpp"

namespace app {

Experiment features_experiment() {
    return {.kind = "features",
            .settings = joined(
                {{{"features.answers", "200", "different answers for each target, and as many that miss"},
                  {"features.similarity", "0.99", "lowest similarity of an answer"},
                  {"features.difference", "0.001",
                   "minimum difference of two answers: 1 less the correlation of their heights"},
                  {"features.starts", "6000", "maximum number of starts"},
                  {"features.held-out", "128", "starts of the held-out check"},
                  {"targets.files", "", "target curves (CSV), separated by commas"},
                  max_pressure_setting("targets.", "1.6e-4")},
                 model_settings("model.")}),
            .files = {"features.csv", "waves.csv", "heldout.csv", "best"},
            .run = findings_of_script};
}

} // namespace app
