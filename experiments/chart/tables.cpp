#include "apps/prompt/units.hpp"
#include "domain/numerics/statistics.hpp"
#include "experiments/chart/chart.hpp"

namespace app {

using nlohmann::json;
using rough::Index;
using rough::Solver;

namespace {

/// One of the errors that are charted.
struct ErrorKind {
    const char* name;
    double ChartRun::*value;
    bool between_steps; ///< also measured between the load steps, so that more of them help

    /// Whether a run has this error and can be compared with other runs. Errors measured at the load steps
    /// are compared only for the usual number of steps. Auto is left out, as it is one of the other solvers.
    bool compares(const ChartRun& run) const {
        return run.setting.method != Solver::automatic && !std::isnan(run.*value) &&
               (between_steps || run.setting.steps == usual_steps);
    }
};
constexpr std::array<ErrorKind, 3> error_kinds{{{"pressure", &ChartRun::error_pressure, false},
                                                {"stiffness", &ChartRun::error_stiffness, true},
                                                {"contact", &ChartRun::error_contact, false}}};

const std::string& method_of(const ChartRun& run) { return rough::name_of(run.setting.method); }

/// Whether a setting with the usual steps and tolerance was solved.
bool is_usual(const ChartRun& run) {
    const ChartSetting& of = run.setting;
    return run.outcome == Outcome::solved && of == usual_setting(of.scene, of.method, of.nodes);
}

/// Sorts runs by time, and puts nested first if it is about as fast as the fastest: it needs no tolerance.
void fastest_first(std::vector<const ChartRun*>& runs) {
    constexpr double same_time = 1.1;
    std::ranges::stable_sort(runs, {}, &ChartRun::seconds);
    const auto nested = std::ranges::find_if(runs, [&](const ChartRun* run) {
        return run->setting.method == Solver::nested && run->seconds <= same_time * runs.front()->seconds;
    });
    if (nested != runs.end())
        std::rotate(runs.begin(), nested, nested + 1);
}

/// Rows of scenes, with a cell for each column: the fastest run that `counts` there, and the next.
template <class Columns, class Counts>
json fastest(const ChartData& data, const Columns& columns, Counts counts) {
    json rows = json::array();
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        json cells = json::array();
        for (const auto column : columns) {
            std::vector<const ChartRun*> runs;
            for (const ChartRun& run : data.runs)
                if (run.setting.scene == scene && run.setting.method != Solver::automatic &&
                    counts(run, column))
                    runs.push_back(&run);
            fastest_first(runs);
            json cell{{"method", ""}, {"seconds", nullptr}, {"next", ""}};
            if (!runs.empty())
                cell.update({{"method", method_of(*runs[0])},
                             {"seconds", runs[0]->seconds},
                             {"nodes", runs[0]->setting.nodes},
                             {"steps", runs[0]->setting.steps}});
            if (runs.size() > 1)
                cell.update({{"next", method_of(*runs[1])}, {"longer", runs[1]->seconds / runs[0]->seconds}});
            cells.push_back(cell);
        }
        rows.push_back(
            {{"scene", data.scenes[scene].name}, {"contact", data.contact(scene)}, {"cells", cells}});
    }
    return rows;
}

/// The fastest method for a curve of 20 steps by scene and grid.
json fastest_by_grid(const ChartData& data) {
    std::set<Index> all;
    for (const ChartRun& run : data.runs)
        all.insert(run.setting.nodes);
    std::vector<Index> grids;
    for (const Index nodes : all)
        if (nodes >= 512 && (grids.empty() || nodes >= 4 * grids.back()))
            grids.push_back(nodes);
        else if (grids.size() > 1 && nodes == *all.rbegin())
            grids.back() = nodes;
    return {{"grids", grids}, {"rows", fastest(data, grids, [](const ChartRun& run, Index nodes) {
                                   return run.setting.nodes == nodes && is_usual(run);
                               })}};
}

/// The fastest setting of each scene that keeps an error below each of four levels.
json fastest_by_error(const ChartData& data, const ErrorKind& kind) {
    constexpr std::array levels{0.03, 0.01, 1e-3, 1e-4};
    return {{"levels", levels}, {"rows", fastest(data, levels, [&](const ChartRun& run, double level) {
                                     return kind.compares(run) && run.*kind.value <= level;
                                 })}};
}

/// How much longer auto took than the faster of the two solvers that it chooses from.
json losses_of_auto(const ChartData& data) {
    std::map<std::pair<std::size_t, Index>, std::map<Solver, double>> seconds; // for each scene and grid
    for (const ChartRun& run : data.runs)
        if (is_usual(run))
            seconds[{run.setting.scene, run.setting.nodes}][run.setting.method] = run.seconds;
    std::vector<double> losses;
    for (auto& [place, of] : seconds)
        if (of.contains(Solver::automatic) && of.contains(Solver::nested) && of.contains(Solver::active_set))
            losses.push_back(of[Solver::automatic] / std::min(of[Solver::nested], of[Solver::active_set]));
    return losses.empty() ? json()
                          : json{{"median", rough::median(losses)}, {"largest", std::ranges::max(losses)}};
}

void add_points(Findings& found, const ChartData& data) {
    Csv& table = found.table("points.csv", "scene,kind,method,seconds,error,best", 6);
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const ErrorKind& kind : error_kinds) {
            std::vector<const ChartRun*> runs;
            for (const ChartRun& run : data.runs)
                if (run.setting.scene == scene && kind.compares(run) && run.*kind.value > 0)
                    runs.push_back(&run);
            std::ranges::stable_sort(
                runs, {}, [&](const ChartRun* run) { return std::pair(run->seconds, run->*kind.value); });
            double lowest = HUGE_VAL; // lowest error of the faster runs: any method, and each method
            std::map<Solver, double> lowest_of;
            for (const ChartRun* run : runs) {
                const double error = run->*kind.value;
                double& lowest_here = lowest_of.try_emplace(run->setting.method, HUGE_VAL).first->second;
                const int best = error < 0.95 * lowest ? 2 : error < 0.95 * lowest_here ? 1 : 0;
                table.row(data.scenes[scene].name, kind.name, method_of(*run), run->seconds, error, best);
                if (best == 2)
                    lowest = error;
                if (error < 0.95 * lowest_here)
                    lowest_here = error;
            }
        }
}

/// Settings that were not tried: for each reason and method their number and their coarsest grid.
void add_left_out(Findings& found, const ChartData& data) {
    std::map<std::pair<std::string, Solver>, std::vector<Index>> all;
    for (const LeftOut& each : data.left_out)
        all[{each.why, each.setting.method}].push_back(each.setting.nodes);
    std::string before = "; " + std::to_string(data.left_out.size()) + " left out: ";
    for (const auto& [key, nodes] : all) {
        const auto& [why, method] = key;
        const Index coarsest = std::ranges::min(nodes);
        found.result["left_out"].push_back({{"method", name_of(method)},
                                            {"settings", nodes.size()},
                                            {"from_nodes", coarsest},
                                            {"why", why}});
        found.summary += std::exchange(before, ", ") + name_of(method) +
                         " from N = " + std::to_string(coarsest) + " (" + why + ")";
    }
}

} // namespace

double ChartData::contact(std::size_t scene) const {
    double fraction = 0;
    for (const ChartRun& run : runs)
        if (run.setting.scene == scene && run.outcome == Outcome::solved)
            fraction = run.contact_fraction;
    return fraction;
}

Csv chart_table(const ChartData& data) {
    Csv table(
        "scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
        "iterations,outcome",
        6);
    for (const ChartRun& run : data.runs) {
        const ChartScene& scene = data.scenes[run.setting.scene];
        table.row(scene.name, name_of(scene.body.kernel), method_of(run), run.setting.nodes,
                  run.setting.steps, run.setting.tolerance, run.seconds, run.error_pressure,
                  run.error_stiffness, run.error_contact, run.iterations, name_of(run.outcome));
    }
    for (const json& row : data.model_runs)
        table.add(row);
    return table;
}

Findings findings_of(const ChartData& data) {
    Findings found = data.models;
    found.summary = std::to_string(data.runs.size()) + " settings charted";
    const Csv& runs = found.tables.emplace("chart.csv", chart_table(data)).first->second;
    add_points(found, data);
    json& facts = found.result;
    facts.update({{"fastest_by_grid", fastest_by_grid(data)},
                  {"fastest_by_pressure_error", fastest_by_error(data, error_kinds[0])},
                  {"fastest_by_stiffness_error", fastest_by_error(data, error_kinds[1])},
                  {"left_out", json::array()},
                  {"tried", data.runs.size()},
                  {"not_tried", data.left_out.size()},
                  {"late", std::ranges::count(data.runs, true, &ChartRun::late)},
                  {"limit_seconds", data.limit},
                  {"auto_over_fastest", losses_of_auto(data)},
                  {"failures", json::array()},
                  {"runs", runs.rows()}});
    add_left_out(found, data);
    for (const LeftOut& each : data.left_out)
        if (each.why == time_over || each.why == interrupted) {
            facts["ended_early"] = {{"nodes", each.setting.nodes}};
            break;
        }
    for (const ChartRun& run : data.runs)
        if (run.outcome != Outcome::solved && !run.late)
            facts["failures"].push_back({{"method", method_of(run)},
                                         {"scene", data.scenes[run.setting.scene].name},
                                         {"nodes", run.setting.nodes},
                                         {"outcome", name_of(run.outcome)}});
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        const ChartScene& of = data.scenes[scene];
        facts["solver_scenes"].push_back({{"name", of.name},
                                          {"words", of.words},
                                          {"reference", of.reference},
                                          {"contact", data.contact(scene)}});
    }
    return found;
}

} // namespace app
