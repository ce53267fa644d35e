#include "apps/experiments/variants/experiment.hpp"

#include "apps/experiments/paper/settings.hpp"
#include "apps/prompt/model_settings.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(experiment) {
    const app::Settings settings = app::read_ini(
        fuzz::as_file(bytes), app::joined({app::paper_settings(), app::variants_settings()}), {});
    app::model_from(settings, "model.");
    settings.seed("experiment.seed");
    settings.names_under("variants.");
}
