#include "apps/commands/commands.hpp"
#include "apps/experiments/contact_trial.hpp"
#include "apps/experiments/stability/page.hpp"
#include "apps/experiments/stability/reference.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/text/nearest.hpp"

#include <algorithm>

namespace app {

namespace {

constexpr double seconds_per_cell = 30;

std::vector<Setting> stability_settings() {
    return {
        {"out", "", "folder to write [out/stability]"},
        {"scene", "", "only the scene of this name"},
        {"force", "", "write over an existing table", true},
    };
}

/// Throws rough::InputError unless the name is "" or that of a scene.
void expect_scene(const std::string& name) {
    std::vector<std::string> names;
    for (const StabilityScene& scene : stability_scenes())
        if (std::find(names.begin(), names.end(), scene.name) == names.end())
            names.push_back(scene.name);
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        throw rough::InputError("--scene: '" + name + "' given as a scene" + ga::suggestion(name, names));
}

std::vector<StabilityCell> table_of(const std::string& only, Progress& progress) {
    std::vector<StabilityCell> cells;
    for (const StabilityScene& scene : stability_scenes()) {
        if (!only.empty() && scene.name != only)
            continue;
        StabilityReference reference(scene);
        for (std::size_t method = 0; method < solver_names().size(); ++method) {
            progress.show(scene.name + " (" + name_of(scene.body.kernel) + "): " + solver_names()[method]);
            rough::ContactOptions options;
            options.solver = static_cast<rough::Solver>(method);
            ContactTrial trial = try_contact(scene, options, seconds_per_cell);
            reference.judge(trial, promised_tolerance(trial.curve, options));
            cells.push_back({scene.name, name_of(scene.body.kernel), solver_names()[method],
                             scene.has_solution, std::move(trial)});
        }
    }
    return cells;
}

std::string csv_of(const std::vector<StabilityCell>& cells) {
    Csv table("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message", 6);
    for (const StabilityCell& cell : cells) {
        const ContactTrial& trial = cell.trial;
        std::optional<double> residual;
        if (!trial.curve.steps.empty())
            residual = trial.kkt_residual();
        table.row(cell.scene, cell.kernel, cell.method, name_of(trial.outcome), residual,
                  trial.curve.iterations, trial.seconds, trial.message);
    }
    return table.text();
}

} // namespace

int stability(const Words& words) {
    if (shows_help(words, "stability [--out DIR]",
                   "Tries every contact solver on scenes in which methods fail, and says which solved them, "
                   "refused them or did not converge; 'wrong' is a result that a second opinion contradicts. "
                   "Writes stability.csv and stability.html; a cell takes at most 30 s.",
                   stability_settings(),
                   {"stability --out out/stability", "stability --scene spike --out out/spike"}))
        return 0;
    const Settings settings = read_command_line(words, stability_settings());
    const std::string only = settings.text("scene");
    expect_scene(only);
    const OutputFolder folder(settings.text("out"), "stability",
                              {{"stability.csv", "stability.html"}, {}, settings.is_on("force")});
    Progress progress;
    const std::vector<StabilityCell> cells = table_of(only, progress);
    rough::write_atomically(folder.path() / "stability.csv", csv_of(cells));
    rough::write_atomically(folder.path() / "stability.html", stability_page(cells));
    say(summary_of(cells) + "\n" + (folder.path() / "stability.html").string());
    for (const StabilityCell& cell : cells)
        if (cell.trial.outcome == Outcome::wrong)
            return 3;
    return 0;
}

} // namespace app
