#include "apps/experiments/chart/data.hpp"

#include "apps/prompt/model_settings.hpp"

#include <algorithm>
#include <set>

namespace app {

const ChartRun* ChartData::at(const ChartSetting& setting) const {
    const auto found =
        std::find_if(runs.begin(), runs.end(), [&](const ChartRun& run) { return run.setting == setting; });
    return found == runs.end() ? nullptr : &*found;
}

const ChartRun* ChartData::solved(const ChartSetting& setting) const {
    const ChartRun* run = at(setting);
    return run && run->outcome == Outcome::solved ? run : nullptr;
}

double ChartData::contact(std::size_t scene) const {
    double fraction = 0;
    for (const ChartRun& run : runs)
        if (run.setting.scene == scene && run.outcome == Outcome::solved)
            fraction = run.contact_fraction;
    return fraction;
}

std::vector<rough::Index> ChartData::grids() const {
    std::set<rough::Index> grids;
    for (const ChartRun& run : runs)
        grids.insert(run.setting.nodes);
    return {grids.begin(), grids.end()};
}

Csv chart_table(const ChartData& data) {
    Csv table(
        "scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
        "iterations,outcome",
        6);
    const auto known = [](double error) {
        return error == ChartRun::unknown ? std::nullopt : std::optional(error);
    };
    for (const ChartRun& run : data.runs) {
        const ChartSetting& setting = run.setting;
        const ChartedScene& scene = data.scenes[setting.scene];
        table.row(scene.name, scene.kernel, name_of(setting.method), setting.nodes, setting.steps,
                  setting.tolerance, run.seconds, known(run.error_pressure), known(run.error_stiffness),
                  known(run.error_contact), run.iterations, name_of(run.outcome));
    }
    for (const ModelRun& run : data.models.runs) { // errors of the fraction itself, as above
        const ModelScene& scene = data.models.scenes[run.scene];
        const auto errors = run.contact_fraction - scene.contact_fraction;
        const double fraction = root_mean_square(errors);
        table.row(scene.name, name_of(rough::Kernel::periodic), run.model, run.nodes, scene.pressure.size(),
                  0.0, run.seconds, std::optional<double>(), errors_of(run, scene).second, fraction, 0,
                  name_of(Outcome::solved));
    }
    return table;
}

} // namespace app
