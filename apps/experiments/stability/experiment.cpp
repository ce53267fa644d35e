#include "apps/experiments/experiment.hpp"

#include "apps/experiments/stability/cells.hpp"
#include "apps/experiments/stability/reference.hpp"
#include "apps/prompt/model_settings.hpp"

#include <algorithm>

namespace app {

namespace {

constexpr double seconds_per_cell = 30;

/// The scenes of a name on all kernels, or all of them.
std::vector<StabilityScene> scenes_from(const Settings& settings) {
    std::vector<StabilityScene> scenes = stability_scenes();
    if (!settings.has("stability.scene"))
        return scenes;
    std::vector<std::string> names;
    for (const StabilityScene& scene : scenes)
        if (std::find(names.begin(), names.end(), scene.name) == names.end())
            names.push_back(scene.name);
    const std::string name = names[settings.one_of("stability.scene", names)];
    std::erase_if(scenes, [&](const StabilityScene& scene) { return scene.name != name; });
    return scenes;
}

std::vector<StabilityCell> tried(const Settings& settings, const Conditions& conditions) {
    std::vector<StabilityCell> cells;
    for (const StabilityScene& scene : scenes_from(settings)) {
        if (conditions.stop)
            break;
        StabilityReference reference(scene);
        for (std::size_t method = 0; method < rough::solver_names().size(); ++method) {
            conditions.progress.show(scene.name + " (" + name_of(scene.body.kernel) +
                                     "): " + rough::solver_names()[method]);
            rough::ContactOptions options;
            options.solver = static_cast<rough::Solver>(method);
            ContactTrial trial = try_contact(scene, options, seconds_per_cell);
            reference.verifier(trial, promised_tolerance(trial.curve, options));
            cells.push_back({scene.name, name_of(scene.body.kernel), rough::solver_names()[method],
                             scene.has_solution, std::move(trial)});
        }
    }
    return cells;
}

Findings run_stability(const Settings& settings, const Conditions& conditions) {
    const auto cells = std::make_shared<const std::vector<StabilityCell>>(tried(settings, conditions));
    if (cells->empty())
        return {};
    const bool wrong = std::any_of(cells->begin(), cells->end(), [](const StabilityCell& cell) {
        return cell.trial.outcome == Outcome::wrong;
    });
    return {.write = [cells, origin = conditions.origin,
                      folder = conditions.folder] { write_stability(*cells, origin, folder); },
            .summary = summary_of(*cells),
            .code = wrong ? 3 : 0};
}

} // namespace

Experiment stability_experiment() {
    return {.kind = "stability",
            .summary =
                "Tries every contact solver on scenes in which methods fail, and says which solved them, "
                "refused them or did not converge; 'wrong' is a result that a second opinion "
                "contradicts. Writes stability.csv and a page; a cell takes at most 30 s.",
            .settings = {{"stability.scene", "", "only the scene of this name"}},
            .files = {"stability.csv"},
            .run = run_stability,
            .examples = {"stability --out out/stability", "stability --scene spike --out out/spike"}};
}

} // namespace app
