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

/// The difference of a load step from its reference, in words; "" if they agree.
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
        line << what << " of step " << j + 1 << " is " << given << ", but the reference has " << least;
        if (most > least)
            line << " to " << most;
        return line.str();
    }
    return "";
}

/// A scene and the trial of each solver, in the order of their names.
struct StabilityRow {
    std::string scene, kernel;
    bool has_solution;
    std::vector<ContactTrial> trials;
};
using Rows = std::vector<StabilityRow>;

constexpr std::array outcomes{Outcome::solved, Outcome::refused, Outcome::not_converged, Outcome::wrong};

/// Number of cells with an outcome, for one method or for all (-1).
long count(const Rows& rows, Outcome outcome, int method = -1) {
    long number = 0;
    for (const StabilityRow& row : rows)
        for (std::size_t m = 0; m < row.trials.size(); ++m)
            number +=
                row.trials[m].outcome == outcome && (method < 0 || m == static_cast<std::size_t>(method));
    return number;
}

/// Outcomes of each method over all scenes.
json by_method(const Rows& rows) {
    json table = json::array();
    for (std::size_t m = 0; m < rough::solver_names().size(); ++m) {
        table.push_back({{"method", rough::solver_names()[m]},
                         {"missed", std::count_if(rows.begin(), rows.end(), [&](const StabilityRow& row) {
                              return row.has_solution && row.trials[m].outcome != Outcome::solved;
                          })}});
        for (const Outcome outcome : outcomes)
            table.back()["outcomes"].push_back(count(rows, outcome, static_cast<int>(m)));
    }
    return table;
}

/// Each scene and kernel with one cell per method.
json by_scene(const Rows& rows) {
    json table = json::array();
    for (const StabilityRow& row : rows) {
        table.push_back({{"scene", row.scene}, {"kernel", row.kernel}});
        for (const ContactTrial& trial : row.trials) {
            const bool solved = trial.outcome == Outcome::solved;
            table.back()["cells"].push_back({{"milliseconds", solved ? json(1000 * trial.seconds) : json()},
                                             {"failure", solved ? "" : name_of(trial.outcome)}});
        }
    }
    return table;
}

/// Messages of the cells that were not solved; equal ones of a scene once, with their methods.
json messages(const Rows& rows) {
    json table = json::array();
    for (const StabilityRow& row : rows) {
        std::map<std::string, std::size_t> known;
        for (std::size_t m = 0; m < row.trials.size(); ++m) {
            const ContactTrial& trial = row.trials[m];
            const std::string& method = rough::solver_names()[m];
            if (trial.outcome == Outcome::solved)
                continue;
            const auto [entry, is_new] = known.emplace(trial.message, table.size());
            if (is_new)
                table.push_back({{"scene", row.scene},
                                 {"kernel", row.kernel},
                                 {"methods", method},
                                 {"outcome", name_of(trial.outcome)},
                                 {"message", trial.message}});
            else
                table[entry->second]["methods"].get_ref<std::string&>() += ", " + method;
        }
    }
    return table;
}

Findings findings_of(const Rows& rows) {
    Csv table("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message", 6);
    for (const StabilityRow& row : rows)
        for (std::size_t m = 0; m < row.trials.size(); ++m) {
            const ContactTrial& trial = row.trials[m];
            table.row(row.scene, row.kernel, rough::solver_names()[m], name_of(trial.outcome),
                      trial.curve.steps.empty() ? std::nullopt : std::optional(trial.kkt_residual()),
                      trial.curve.iterations, trial.seconds, trial.message);
        }
    json names = json::array();
    std::string summary; // "433 cells: 380 solved, ..."
    for (const Outcome outcome : outcomes) {
        names.push_back(name_of(outcome));
        summary += (summary.empty() ? std::to_string(table.rows().size()) + " cells: " : ", ") +
                   std::to_string(count(rows, outcome)) + " " + name_of(outcome);
    }
    return {.result = {{"summary", summary},
                       {"outcomes", names},
                       {"methods", by_method(rows)},
                       {"scenes", by_scene(rows)},
                       {"messages", messages(rows)},
                       {"runs", table.rows()}},
            .files = {{"stability.csv", table.text()}},
            .summary = summary,
            .code = count(rows, Outcome::wrong) > 0 ? 3 : 0};
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
    Rows rows;
    for (const StabilityScene& scene : scenes_from(settings)) {
        if (conditions.stop)
            break;
        StabilityReference reference(scene);
        const std::string& kernel = name_of(scene.body.kernel);
        rows.push_back({scene.name, kernel, scene.has_solution, {}});
        for (const std::string& method : rough::solver_names()) {
            conditions.progress.show(scene.name + " (" + kernel + "): " + method);
            rough::ContactOptions options;
            options.solver = rough::solver_named(method);
            ContactTrial& trial =
                rows.back().trials.emplace_back(try_contact(scene, options, seconds_per_cell));
            reference.verifier(trial, promised_tolerance(trial.curve, options));
        }
    }
    return rows.empty() ? Findings() : findings_of(rows);
}

} // namespace

const std::vector<StabilityReference::Span>& StabilityReference::spans(double tolerance) {
    std::vector<Span>& spans = spans_[tolerance];
    if (!spans.empty())
        return spans;
    const double largest = largest_displacement(scene_.profile, scene_.body);
    const double range = scene_.profile.heights.maxCoeff() - scene_.profile.heights.minCoeff();
    for (const double displacement : scene_.displacements) {
        // The oracle needs a displacement above 0; a tiny one stands for first touch.
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
                "Tries every contact solver on scenes in which methods fail. A cell is solved, refused, not "
                "converged, or wrong if a second solution contradicts it. Writes stability.csv and a page; "
                "a cell takes at most 30 s.",
            .settings = {{"stability.scene", "", "only the scene of this name"}},
            .files = {"stability.csv"},
            .run = run_stability,
            .examples = {"stability --out out/stability", "stability --scene spike --out out/spike"}};
}

} // namespace app
