#include "apps/experiments/solvers/stability.hpp"

#include "apps/experiments/experiment.hpp"
#include "apps/report/csv.hpp"
#include "domain/contact/solvers/oracle.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/plain_stream.hpp"

#include <cmath>

namespace app {

using nlohmann::json;

namespace {

constexpr rough::Index largest_for_oracle = 256;
constexpr double seconds_per_cell = 30; ///< and for a second opinion

std::pair<double, double> span_of(const std::vector<double>& values, double factor = 1) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {factor * *least, factor * *most};
}

/// How a load step differs from its reference, or "".
template <class Span>
std::string difference(const rough::LoadStep& step, std::size_t j, const Span& span, double tolerance) {
    const std::array<std::pair<const char*, double>, 3> results{
        {{"pressure", step.pressure},
         {"stiffness", step.tangent_stiffness},
         {"number of contact nodes", static_cast<double>(step.contact_nodes)}}};
    for (std::size_t k = 0; k < results.size(); ++k) {
        const auto& [what, given] = results[k];
        const auto& [least, most] = span[k];
        const double slack = k == 2 ? 0 : tolerance * std::max(std::abs(least), std::abs(most));
        if (given >= least - slack && given <= most + slack)
            continue;
        rough::PlainStream line;
        line.precision(12);
        line << what << " of step " << j + 1 << " is " << given << " where the reference has " << least;
        if (most > least)
            line << " to " << most;
        return line.str();
    }
    return "";
}

/// A method on a scene.
struct StabilityCell {
    std::string scene, kernel, method;
    bool has_solution;
    ContactTrial trial;
};
using Cells = std::vector<StabilityCell>;

constexpr std::array outcomes{Outcome::solved, Outcome::refused, Outcome::not_converged, Outcome::wrong};

template <class Counts>
long count(const Cells& cells, Counts counts) {
    return std::count_if(cells.begin(), cells.end(), counts);
}

/// Outcomes of each method over all scenes.
json by_method(const Cells& cells) {
    json rows = json::array();
    for (const std::string& method : rough::solver_names()) {
        json row{{"method", method}, {"missed", count(cells, [&](const StabilityCell& cell) {
                                          return cell.method == method && cell.has_solution &&
                                                 cell.trial.outcome != Outcome::solved;
                                      })}};
        for (const Outcome outcome : outcomes)
            row["outcomes"].push_back(count(cells, [&](const StabilityCell& cell) {
                return cell.method == method && cell.trial.outcome == outcome;
            }));
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Each scene and kernel with one cell per method.
json by_scene(const Cells& cells) {
    json rows = json::array();
    const std::size_t methods = rough::solver_names().size();
    for (std::size_t first = 0; first < cells.size(); first += methods) {
        json row{{"scene", cells[first].scene}, {"kernel", cells[first].kernel}};
        for (std::size_t k = first; k < first + methods; ++k) {
            const ContactTrial& trial = cells[k].trial;
            const bool solved = trial.outcome == Outcome::solved;
            row["cells"].push_back({{"milliseconds", solved ? json(1000 * trial.seconds) : json()},
                                    {"failure", solved ? "" : name_of(trial.outcome)}});
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Messages of the cells that were not solved; equal ones of a scene once, with their methods.
json messages(const Cells& cells) {
    std::vector<json> rows;
    std::map<std::string, std::size_t> known;
    for (const StabilityCell& cell : cells) {
        if (cell.trial.outcome == Outcome::solved)
            continue;
        const auto [entry, is_new] =
            known.emplace(cell.scene + "\n" + cell.kernel + "\n" + cell.trial.message, rows.size());
        if (is_new)
            rows.push_back({{"scene", cell.scene},
                            {"kernel", cell.kernel},
                            {"methods", cell.method},
                            {"outcome", name_of(cell.trial.outcome)},
                            {"message", cell.trial.message}});
        else
            rows[entry->second]["methods"] =
                rows[entry->second]["methods"].get<std::string>() + ", " + cell.method;
    }
    return rows;
}

/// "433 cells: 380 solved, ..."
std::string summary_of(const Cells& cells) {
    std::string text = std::to_string(cells.size()) + " cells:";
    for (const Outcome outcome : outcomes)
        text +=
            (outcome == outcomes.front() ? " " : ", ") +
            std::to_string(count(cells, [&](const auto& cell) { return cell.trial.outcome == outcome; })) +
            " " + name_of(outcome);
    return text;
}

Findings findings_of(const Cells& cells) {
    Csv table("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message", 6);
    for (const StabilityCell& cell : cells) {
        const ContactTrial& trial = cell.trial;
        table.row(cell.scene, cell.kernel, cell.method, name_of(trial.outcome),
                  trial.curve.steps.empty() ? std::nullopt : std::optional(trial.kkt_residual()),
                  trial.curve.iterations, trial.seconds, trial.message);
    }
    json names = json::array();
    for (const Outcome outcome : outcomes)
        names.push_back(name_of(outcome));
    const bool wrong =
        count(cells, [](const StabilityCell& cell) { return cell.trial.outcome == Outcome::wrong; }) > 0;
    return {.result = {{"summary", summary_of(cells)},
                       {"outcomes", names},
                       {"methods", by_method(cells)},
                       {"scenes", by_scene(cells)},
                       {"messages", messages(cells)},
                       {"runs", table.rows()}},
            .files = {{"stability.csv", table.text()}},
            .summary = summary_of(cells),
            .code = wrong ? 3 : 0};
}

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

Findings run_stability(const Settings& settings, const Conditions& conditions) {
    Cells cells;
    for (const StabilityScene& scene : scenes_from(settings)) {
        if (conditions.stop)
            break;
        StabilityReference reference(scene);
        const std::string& kernel = name_of(scene.body.kernel);
        for (const std::string& method : rough::solver_names()) {
            conditions.progress.show(scene.name + " (" + kernel + "): " + method);
            rough::ContactOptions options;
            options.solver = rough::solver_named(method);
            ContactTrial trial = try_contact(scene, options, seconds_per_cell);
            reference.verifier(trial, promised_tolerance(trial.curve, options));
            cells.push_back({scene.name, kernel, method, scene.has_solution, std::move(trial)});
        }
    }
    return cells.empty() ? Findings() : findings_of(cells);
}

} // namespace

const std::vector<StabilityReference::Span>& StabilityReference::spans(double tolerance) {
    std::vector<Span>& spans = spans_[tolerance];
    if (!spans.empty())
        return spans;
    const double largest = largest_displacement(scene_.profile, scene_.body);
    const double range = scene_.profile.heights.maxCoeff() - scene_.profile.heights.minCoeff();
    for (const double displacement : scene_.displacements) {
        // First loading: the oracle needs some displacement, which stands for none.
        const double at = displacement > 0 ? displacement : 1e-9 * range;
        const rough::Oracle oracle = consult_oracle(
            scene_.profile, scene_.body,
            {at * (1 - tolerance), std::min(at, largest), std::min(at * (1 + tolerance), largest)});
        spans.push_back({span_of(oracle.pressure, displacement > 0), span_of(oracle.tangent_stiffness),
                         span_of({oracle.contact_nodes.begin(), oracle.contact_nodes.end()})});
    }
    return spans;
}

std::vector<StabilityReference::Span> StabilityReference::by_another(rough::Solver verified) const {
    rough::ContactOptions options;
    std::vector<Span> spans;
    for (const rough::Solver solver :
         {rough::Solver::nested, rough::Solver::active_set, rough::Solver::polonsky_keer}) {
        options.solver = solver;
        if (solver == verified || !spans.empty())
            continue;
        for (const rough::LoadStep& step : try_contact(scene_, options, seconds_per_cell).curve.steps) {
            const auto nodes = static_cast<double>(step.contact_nodes);
            spans.push_back({{{step.pressure, step.pressure},
                              {step.tangent_stiffness, step.tangent_stiffness},
                              {nodes, nodes}}});
        }
    }
    return spans;
}

void StabilityReference::verifier(ContactTrial& trial, double tolerance) {
    if (trial.outcome != Outcome::solved)
        return;
    const bool small = scene_.profile.nodes() <= largest_for_oracle;
    const std::vector<Span> expected = small ? spans(tolerance) : by_another(trial.curve.solver);
    if (!small)
        tolerance = std::max(tolerance, 10 * rough::ContactOptions().tolerance);
    for (std::size_t j = 0; j < expected.size() && trial.outcome == Outcome::solved; ++j) {
        trial.message = difference(trial.curve.steps[j], j, expected[j], tolerance);
        if (!trial.message.empty())
            trial.outcome = Outcome::wrong;
    }
}

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
