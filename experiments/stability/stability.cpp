#include "experiments/stability/stability.hpp"

#include "apps/experiments/experiment.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/numerics/statistics.hpp"

namespace app {

using nlohmann::json;

namespace {

constexpr rough::Index max_small = 256; ///< nodes of a small grid
constexpr double seconds_per_cell = 30; ///< also for the solver that verifies it
/// Largest numbers of nodes of a map on which `nnls`, and `nested` and `polonsky-keer`, are tried. On larger
/// maps they would take minutes.
constexpr rough::Index max_nnls = 1000, max_every = 100'000;

/// How a load step differs from the range of its reference's steps, or "".
std::string difference(const rough::LoadStep& step, std::size_t j, const std::vector<rough::LoadStep>& reference,
                       double tolerance, double node_slack) {
    using Step = const rough::LoadStep&;
    const std::pair<const char*, double (*)(Step)> results[] = {
        {"pressure", [](Step one) { return one.pressure; }},
        {"stiffness", [](Step one) { return one.tangent_stiffness; }},
        {"number of contact nodes", [](Step one) { return static_cast<double>(one.contact_nodes); }}};
    for (std::size_t k = 0; k < std::size(results); ++k) {
        const auto& [what, value] = results[k];
        const std::vector<double> allowed = rough::column(reference, value);
        const double given = value(step), lowest = std::ranges::min(allowed), highest = std::ranges::max(allowed);
        const double slack = k == 2 ? node_slack : tolerance * std::max(std::abs(lowest), std::abs(highest));
        if (given >= lowest - slack && given <= highest + slack) continue;
        rough::PlainStream line;
        line.precision(12);
        line << what << " of step " << j + 1 << " is " << given << ", but the reference has " << lowest;
        if (highest > lowest) line << " to " << highest;
        return line.str();
    }
    return "";
}

/// The scenes of a name on all kernels, bred ones, or all of them.
std::vector<ContactScene> scenes_from(const Settings& settings, const RunConditions& conditions) {
    if (settings.has("stability.search"))
        return bred_scenes(settings.whole("stability.search"), conditions.origin.seed, conditions.origin.threads,
                           conditions.stop);
    if (const std::string name = settings.text("stability.scene"); is_bred(name)) return {bred_scene(name)};
    std::vector<ContactScene> scenes = stability_scenes(settings.is_on("stability.large"));
    if (!settings.has("stability.scene")) return scenes;
    std::vector<std::string> names;
    for (const ContactScene& scene : scenes)
        if (std::ranges::find(names, scene.name) == names.end()) names.push_back(scene.name);
    const std::string name = names[settings.one_of("stability.scene", names)];
    std::erase_if(scenes, [&](const ContactScene& scene) { return scene.name != name; });
    return scenes;
}

/// The kind of a scene: "layered lines", with "near full contact" if 99 % of the nodes or more touch.
std::string group_of(const ContactScene& scene, double contact) {
    return std::string(scene.body.layering.layers.empty() ? "" : "layered ") +
           (scene.profile.is_2d() ? "maps" : "lines") + (scene.body.yields() ? " with a hardness" : "") +
           (scene.pressures.empty() ? "" : ", given loads") + (contact >= 0.99 ? ", near full contact" : "");
}

/// Words such as "spike (free), flat (strip) and 3 more".
std::string listed_scenes(const std::vector<std::string>& scenes) {
    std::string words;
    for (std::size_t i = 0; i < scenes.size() && i < 6; ++i) words += (i == 0 ? "" : ", ") + scenes[i];
    return words + (scenes.size() > 6 ? " and " + std::to_string(scenes.size() - 6) + " more" : "");
}

/// Whether a solver would take minutes on a scene.
bool takes_minutes(const ContactScene& scene, rough::Solver solver) {
    const bool is_every = solver == rough::Solver::nested || solver == rough::Solver::polonsky_keer;
    const rough::Index nodes = scene.profile.is_2d() ? scene.profile.nodes() : 0;
    return (solver == rough::Solver::nnls && nodes > max_nnls) || (is_every && nodes > max_every);
}

ContactTrial verified_trial(const ContactScene& scene, rough::Solver solver) {
    if (takes_minutes(scene, solver)) return {Outcome::refused, "not tried, because it would take minutes", {}};
    rough::ContactOptions options;
    options.solver = solver;
    ContactTrial trial = try_contact(scene, options, seconds_per_cell);
    verify(scene, trial);
    return trial;
}

Findings run_stability(const Settings& settings, const RunConditions& conditions) {
    const std::vector<std::string>& methods = rough::solver_names();
    Findings found;
    Csv& table = found.table("stability.csv", "scene,kernel,method,outcome,kkt_residual,iterations,seconds,message", 6);
    json scenes = json::array(), messages = json::array();
    std::map<std::string, std::map<std::string, std::array<long, 2>>> groups; // solved and tried, by method
    std::set<std::string> unsolvable;                                         // names of the scenes without a solution
    for (const ContactScene& scene : scenes_from(settings, conditions)) {
        if (conditions.stop) break;
        const std::string& kernel = name_of(scene.body.kernel);
        scenes.push_back({{"scene", scene.name}, {"kernel", kernel}});
        if (!scene.has_solution) unsolvable.insert(scene.name + " (" + kernel + ")");
        double contact = 0;
        std::map<std::string, bool> solved_by;
        std::map<std::string, std::size_t> known; // equal messages of a scene appear once
        for (std::size_t m = 0; m < methods.size(); ++m) {
            conditions.progress.show(scene.name + " (" + kernel + "): " + methods[m]);
            const ContactTrial trial = verified_trial(scene, static_cast<rough::Solver>(m));
            const std::string& outcome = name_of(trial.outcome);
            const bool solved = trial.outcome == Outcome::solved;
            const auto residuals = rough::column(trial.curve.steps, &rough::LoadStep::kkt_residual);
            table.row(scene.name, kernel, methods[m], outcome, residuals.empty() ? NAN : std::ranges::max(residuals),
                      trial.curve.iterations, trial.seconds, trial.message);
            scenes.back()["cells"].push_back(
                {{"milliseconds", solved ? json(1000 * trial.seconds) : json()}, {"failure", solved ? "" : outcome}});
            solved_by[methods[m]] = solved;
            if (solved) {
                contact = std::max(contact, trial.curve.steps.back().contact_fraction);
                continue;
            }
            const auto [entry, is_new] = known.emplace(trial.message, messages.size());
            if (is_new)
                messages.push_back({{"scene", scene.name},
                                    {"kernel", kernel},
                                    {"methods", methods[m]},
                                    {"outcome", outcome},
                                    {"message", trial.message}});
            else
                messages[entry->second]["methods"].get_ref<std::string&>() += ", " + methods[m];
        }
        if (scene.has_solution)
            for (const auto& [method, solved] : solved_by) {
                auto& counts = groups[group_of(scene, contact)][method];
                counts[0] += solved, ++counts[1];
            }
    }
    if (scenes.empty()) return {};
    for (auto& [group, counts] : groups) {
        json cells = json::array();
        for (const std::string& method : methods)
            cells.push_back(std::to_string(counts[method][0]) + " of " + std::to_string(counts[method][1]));
        found.result["groups"].push_back({{"group", group}, {"cells", cells}});
    }
    const auto trials = [&](Outcome outcome) {
        return std::ranges::count_if(table.rows(), [&](const json& row) { return row["outcome"] == name_of(outcome); });
    };
    const std::string verdict = stability_verdict(table.rows(), unsolvable);
    found.summary = verdict + " " + std::to_string(table.rows().size()) + " trials of a solver on a scene";
    for (const Outcome outcome : {Outcome::solved, Outcome::refused, Outcome::not_converged, Outcome::wrong})
        found.summary +=
            (outcome == Outcome::solved ? ": " : ", ") + std::to_string(trials(outcome)) + " " + name_of(outcome);
    found.result.update({{"verdict", verdict},
                         {"interrupted", conditions.stop.load()},
                         {"methods", methods},
                         {"scenes", scenes},
                         {"messages", messages},
                         {"runs", table.rows()}});
    found.code = trials(Outcome::wrong) > 0 ? 3 : 0;
    return found;
}

} // namespace

std::string stability_verdict(const json& rows, const std::set<std::string>& unsolvable) {
    std::vector<std::string> wrong, missed;
    std::map<std::string, long> others; // scenes missed by other solvers
    std::set<std::string> solvable;
    for (const json& row : rows) {
        const std::string scene = row["scene"].get<std::string>() + " (" + row["kernel"].get<std::string>() + ")",
                          method = row["method"];
        if (row["outcome"] == name_of(Outcome::wrong)) wrong.push_back(method + " on " + scene);
        if (unsolvable.contains(scene)) continue;
        solvable.insert(scene);
        if (row["outcome"] == name_of(Outcome::solved)) continue;
        if (method == rough::name_of(rough::Solver::automatic))
            missed.push_back(scene);
        else
            ++others[method];
    }
    if (solvable.empty())
        return (wrong.empty() ? "No" : "Wrong curves: " + listed_scenes(wrong) + ". No") +
               std::string(" scene with a solution was tried.");
    std::string words = wrong.empty() ? "" : "Wrong curves: " + listed_scenes(wrong) + ". ";
    const std::string count = std::to_string(solvable.size()) + (solvable.size() == 1 ? " scene" : " scenes");
    words += missed.empty() ? "auto, the default, failed on none of the " + count + " with a solution"
                            : "auto, the default, failed on " + std::to_string(missed.size()) + " of " + count +
                                  " with a solution: " + listed_scenes(missed);
    if (wrong.empty()) words += ", and no solver gave a wrong curve";
    words += ".";
    for (const auto& [method, number] : others)
        words += (others.begin()->first == method ? " Scenes without a right curve, with those refused: " : ", ") +
                 method + " " + std::to_string(number);
    return words + (others.empty() ? "" : ".");
}

void verify(const ContactScene& scene, ContactTrial& trial) {
    const double tolerance = trial.tolerance;
    const bool by_load = !scene.pressures.empty(), small = !by_load && scene.profile.nodes() <= max_small;
    const double iterative = std::max(tolerance, 10 * rough::ContactOptions().tolerance);
    const double largest = largest_displacement(scene.profile, scene.body);
    const double range = scene.profile.heights.maxCoeff() - scene.profile.heights.minCoeff();
    for (std::size_t j = 0; j < scene.steps() && trial.outcome == Outcome::solved; ++j) {
        rough::LoadStep given = trial.curve.steps[j];
        if (by_load) // the reference at the displacement found must carry the load
            given.pressure = scene.pressures[j];
        const double displacement = by_load ? given.displacement : scene.displacements[j]; // 0 is first touch
        ContactScene verifying = scene;
        verifying.pressures.clear();
        verifying.displacements = {displacement};
        if (small || by_load) { // a node that just touches may or may not count
            // First touch is compared at a small displacement, which the solvers do not treat apart.
            const double at = displacement > 0 ? displacement : 1e-9 * range, share = small ? tolerance : iterative;
            verifying.displacements = {at * (1 - share), std::min(at, largest), std::min(at * (1 + share), largest)};
        }
        rough::ContactCurve reference;
        for (std::size_t m = 1; m < rough::solver_names().size(); ++m) {
            const auto solver = static_cast<rough::Solver>(m);
            if (reference.steps.empty() && solver != trial.curve.solver && (small || solver != rough::Solver::nnls) &&
                !takes_minutes(scene, solver)) {
                rough::ContactOptions options;
                options.solver = solver;
                reference = try_contact(verifying, options, seconds_per_cell).curve;
            }
        }
        if (reference.steps.empty()) continue;
        if (!(displacement > 0)) // first touch is without pressure
            for (rough::LoadStep& step : reference.steps) step.pressure = 0;
        trial.message =
            difference(given, j, reference.steps, small && is_direct(reference.solver) ? tolerance : iterative,
                       by_load ? 1e-3 * static_cast<double>(scene.profile.nodes()) : 0);
        if (!trial.message.empty()) trial.outcome = Outcome::wrong;
    }
}

Experiment stability_experiment() {
    return {.kind = "stability",
            .settings = {{"stability.scene", "", "only the scene of this name"},
                         ga::whole("stability.search", "", 1,
                                   "number of maps that a genetic algorithm presses to find the ten on which auto "
                                   "fails or works hardest; only these are tried"),
                         {"stability.large", "", "also maps of 256 x 256 and 1024 x 1024 nodes (an hour)", true}},
            .files = {"stability.csv"},
            .run = run_stability};
}

} // namespace app
