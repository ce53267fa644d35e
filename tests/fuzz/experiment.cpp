#include "apps/experiments/experiment.hpp"

#include "apps/prompt/model_settings.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(experiment) {
    static const std::vector<app::Setting> known = app::experiment_named("compare").all_settings();
    const app::Settings settings = app::read_ini(fuzz::as_file(bytes), known, {});
    app::model_from(settings, "model.");
    settings.whole<std::uint64_t>("experiment.seed");
    settings.texts_under("surfaces.");
}
