#include "apps/experiments/chart/tables.hpp"

#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace app {

using nlohmann::json;
using rough::Index;
using rough::Solver;

namespace {

constexpr std::array<Solver, 4> methods{Solver::nested, Solver::nnls, Solver::polonsky_keer,
                                        Solver::active_set};

/// Times closer than this are the same time.
constexpr double same_time = 1.1;

/// Brings the fastest to the front, or nested where it is about as fast: it needs no tolerance, and NNLS,
/// which is, is there to check it.
void fastest_first(std::vector<const ChartRun*>& runs) {
    std::stable_sort(runs.begin(), runs.end(),
                     [](const ChartRun* a, const ChartRun* b) { return a->seconds < b->seconds; });
    const auto nested = std::find_if(runs.begin(), runs.end(), [&](const ChartRun* run) {
        return run->setting.method == Solver::nested && run->seconds <= same_time * runs.front()->seconds;
    });
    if (nested != runs.end())
        std::rotate(runs.begin(), nested, nested + 1);
}

/// The usual runs of all methods on a grid, the fastest first.
std::vector<const ChartRun*> ranked(const ChartData& data, std::size_t scene, Index nodes) {
    std::vector<const ChartRun*> runs;
    for (const Solver method : methods)
        if (const ChartRun* run = data.solved(usual_setting(scene, method, nodes)))
            runs.push_back(run);
    fastest_first(runs);
    return runs;
}

struct Share {
    Index from = 0; ///< the coarsest grid of these
    std::size_t settings = 0;
};

/// What was left out, by reason and method.
std::map<std::pair<LeftOutFor, Solver>, Share> left_out(const ChartData& data) {
    std::map<std::pair<LeftOutFor, Solver>, Share> all;
    for (const LeftOut& each : data.left_out) {
        Share& share = all[{each.why, each.setting.method}];
        share.from = share.settings++ == 0 ? each.setting.nodes : std::min(share.from, each.setting.nodes);
    }
    return all;
}

std::string why(const ChartData& data, LeftOutFor reason) {
    switch (reason) {
    case LeftOutFor::limit:
        return "one curve takes more than " + brief(data.limit, 3) + " s";
    case LeftOutFor::unsolved:
        return "refused or not converged on a coarser grid";
    case LeftOutFor::time:
        return "the chart's time was over";
    default:
        return "interrupted";
    }
}

/// Up to this error a model is said to hold.
constexpr double fair = 0.2;

/// Contact fractions between which an error stays fair, around the load where it is lowest; null if nowhere.
json fair_range(const Eigen::VectorXd& errors, const Eigen::VectorXd& fractions) {
    Index best = -1;
    for (Index j = 0; j < errors.size(); ++j)
        if (std::isfinite(errors[j]) && (best < 0 || std::abs(errors[j]) < std::abs(errors[best])))
            best = j;
    if (best < 0 || !(std::abs(errors[best]) <= fair))
        return {};
    Index from = best, to = best;
    while (from > 0 && std::abs(errors[from - 1]) <= fair)
        --from;
    while (to + 1 < errors.size() && std::abs(errors[to + 1]) <= fair)
        ++to;
    return {{"from", fractions[from]}, {"to", fractions[to]}};
}

const char* name_of(ModelRun::Family family) {
    return family == ModelRun::Family::theory ? "theories"
           : family == ModelRun::Family::line ? "one line"
                                              : "solved";
}

json theory_rows(const ModelChart& chart) {
    json rows = json::array();
    for (const ModelRun& run : chart.runs)
        if (const ModelScene& of = chart.scenes[run.scene]; run.family == ModelRun::Family::theory)
            rows.push_back({{"scene", of.name},
                            {"theory", run.model},
                            {"seconds", run.seconds},
                            {"area", fair_range(run.area_errors(of), of.contact_fraction)},
                            {"stiffness", fair_range(run.stiffness_errors(of), of.contact_fraction)}});
    return rows;
}

/// For each map: the line along the lay, one section, and the coarsest grid within 3 %.
json line_rows(const ModelChart& chart) {
    json rows = json::array();
    for (std::size_t scene = 0; scene < chart.scenes.size(); ++scene) {
        const ModelScene& of = chart.scenes[scene];
        const ModelRun *line = nullptr, *section = nullptr, *grid = nullptr;
        for (const ModelRun& run : chart.runs) {
            if (run.scene != scene)
                continue;
            if (run.model == "mean-line")
                line = &run;
            else if (run.model == "section")
                section = &run;
            else if (const auto before = grid ? errors_of(*grid, of) : std::pair(HUGE_VAL, HUGE_VAL);
                     run.family == ModelRun::Family::grid && std::max(before.first, before.second) >= 0.03)
                grid = &run;
        }
        if (!line || !section || !grid)
            continue;
        const auto told = [&](const ModelRun& run) {
            const auto [area, stiffness] = errors_of(run, of);
            return json{
                {"area", area}, {"stiffness", stiffness}, {"seconds", run.seconds}, {"nodes", run.nodes}};
        };
        const auto [area, stiffness] = errors_of(*line, of);
        rows.push_back({{"scene", of.name},
                        {"aspect_ratio", of.aspect_ratio},
                        {"line_is_enough", std::max(area, stiffness) <= fair},
                        {"line", told(*line)},
                        {"section", told(*section)},
                        {"map", told(*grid)}});
    }
    return rows;
}

/// How much longer auto took than the faster of the two solvers that it chooses from.
json losses_of_auto(const ChartData& data) {
    std::vector<double> losses;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const Index nodes : data.grids()) {
            const ChartRun *taken = data.solved(usual_setting(scene, Solver::automatic, nodes)),
                           *nested = data.solved(usual_setting(scene, Solver::nested, nodes)),
                           *active = data.solved(usual_setting(scene, Solver::active_set, nodes));
            if (taken && nested && active)
                losses.push_back(taken->seconds / std::min(nested->seconds, active->seconds));
        }
    return losses.empty() ? json()
                          : json{{"median", rough::median(losses)},
                                 {"largest", *std::max_element(losses.begin(), losses.end())}};
}

/// Points that no other beats in seconds and error, as their places.
std::set<std::size_t> pareto(const std::vector<std::pair<double, double>>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    std::set<std::size_t> front;
    double least = HUGE_VAL;
    for (const std::size_t i : order)
        if (points[i].second < 0.95 * least)
            least = points[i].second, front.insert(i);
    return front;
}

} // namespace

Csv points_table(const ChartData& data) {
    Csv table("scene,kind,method,seconds,error,best", 6);
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const ErrorKind& kind : error_kinds) {
            std::vector<const ChartRun*> runs;
            std::vector<std::pair<double, double>> all;
            std::map<Solver, std::vector<std::size_t>> of_method;
            for (const ChartRun& run : data.runs)
                if (run.setting.scene == scene && run.setting.method != Solver::automatic &&
                    kind.compares(run) && run.*kind.value > 0) {
                    of_method[run.setting.method].push_back(runs.size());
                    runs.push_back(&run);
                    all.emplace_back(run.seconds, run.*kind.value);
                }
            std::vector<int> best(runs.size(), 0);
            for (const auto& [method, places] : of_method) {
                std::vector<std::pair<double, double>> points;
                for (const std::size_t i : places)
                    points.push_back(all[i]);
                for (const std::size_t k : pareto(points))
                    best[places[k]] = 1;
            }
            for (const std::size_t i : pareto(all))
                best[i] = 2;
            std::vector<std::size_t> order(runs.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            std::sort(order.begin(), order.end(),
                      [&](std::size_t a, std::size_t b) { return all[a] < all[b]; });
            for (const std::size_t i : order)
                table.row(data.scenes[scene].name, kind.name, rough::name_of(runs[i]->setting.method),
                          all[i].first, all[i].second, best[i]);
        }
    return table;
}

Csv model_errors_table(const ModelChart& chart) {
    Csv table("scene,family,model,nodes,answers,loads,area,stiffness,seconds", 6);
    for (const ModelRun& run : chart.runs) {
        const auto [area, stiffness] = errors_of(run, chart.scenes[run.scene]);
        table.row(chart.scenes[run.scene].name, name_of(run.family), run.model, run.nodes,
                  run.contact_fraction.array().isFinite().count(), run.contact_fraction.size(), area,
                  stiffness, run.seconds);
    }
    return table;
}

json fastest_by_grid(const ChartData& data) {
    std::vector<Index> grids;
    for (const Index nodes : data.grids())
        if (nodes >= 512 && (grids.empty() || nodes >= 4 * grids.back()))
            grids.push_back(nodes);
        else if (grids.size() > 1 && nodes == data.grids().back())
            grids.back() = nodes;
    json rows = json::array();
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        json row{
            {"scene", data.scenes[scene].name}, {"contact", data.contact(scene)}, {"cells", json::array()}};
        for (const Index nodes : grids) {
            const auto runs = ranked(data, scene, nodes);
            json cell{{"method", ""}, {"next", ""}};
            if (!runs.empty())
                cell = {{"method", rough::name_of(runs[0]->setting.method)}, {"seconds", runs[0]->seconds}};
            if (runs.size() > 1)
                cell.update({{"next", rough::name_of(runs[1]->setting.method)},
                             {"longer", runs[1]->seconds / runs[0]->seconds}});
            row["cells"].push_back(cell);
        }
        rows.push_back(row);
    }
    return {{"grids", grids}, {"rows", rows}};
}

json fastest_by_error(const ChartData& data, const ErrorKind& kind) {
    constexpr std::array levels{0.03, 0.01, 1e-3, 1e-4};
    json rows = json::array();
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        json row{{"scene", data.scenes[scene].name}, {"cells", json::array()}};
        for (const double level : levels) {
            std::vector<const ChartRun*> runs;
            for (const ChartRun& run : data.runs) // auto stands for the solver that it chooses
                if (run.setting.scene == scene && run.setting.method != Solver::automatic &&
                    kind.compares(run) && run.*kind.value <= level)
                    runs.push_back(&run);
            fastest_first(runs);
            json cell{{"method", ""}};
            if (!runs.empty())
                cell = {{"method", rough::name_of(runs[0]->setting.method)},
                        {"seconds", runs[0]->seconds},
                        {"nodes", runs[0]->setting.nodes},
                        {"steps", runs[0]->setting.steps}};
            row["cells"].push_back(cell);
        }
        rows.push_back(row);
    }
    return {{"levels", levels}, {"rows", rows}};
}

json left_out_rows(const ChartData& data) {
    json rows = json::array();
    for (const auto& [key, share] : left_out(data))
        rows.push_back({{"method", rough::name_of(key.second)},
                        {"settings", share.settings},
                        {"from_nodes", share.from},
                        {"why", why(data, key.first)}});
    return rows;
}

json chart_facts(const ChartData& data) {
    json facts{
        {"fastest_by_grid", fastest_by_grid(data)},
        {"fastest_by_pressure_error", fastest_by_error(data, error_kinds[0])},
        {"fastest_by_stiffness_error", fastest_by_error(data, error_kinds[1])},
        {"left_out", left_out_rows(data)},
        {"tried", data.runs.size()},
        {"not_tried", data.left_out.size()},
        {"late", std::count_if(data.runs.begin(), data.runs.end(), [](const auto& run) { return run.late; })},
        {"limit_seconds", data.limit},
        {"auto_over_fastest", losses_of_auto(data)},
        {"theories", theory_rows(data.models)},
        {"lines", line_rows(data.models)},
        {"failures", json::array()}};
    for (const LeftOut& each : data.left_out)
        if (each.why == LeftOutFor::time || each.why == LeftOutFor::interrupt) {
            facts["ended_early"] = {{"nodes", each.setting.nodes}};
            break;
        }
    for (const ChartRun& run : data.runs)
        if (run.outcome != Outcome::solved && !run.late)
            facts["failures"].push_back({{"method", rough::name_of(run.setting.method)},
                                         {"scene", data.scenes[run.setting.scene].name},
                                         {"nodes", run.setting.nodes},
                                         {"outcome", name_of(run.outcome)}});
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        facts["solver_scenes"].push_back({{"name", data.scenes[scene].name},
                                          {"words", data.scenes[scene].words},
                                          {"reference", data.scenes[scene].reference},
                                          {"contact", data.contact(scene)}});
    for (const ModelScene& scene : data.models.scenes)
        facts["model_scenes"].push_back({{"name", scene.name},
                                         {"words", scene.words},
                                         {"reference", scene.reference},
                                         {"rms_slope", scene.rms_slope},
                                         {"rms_height_mm", scene.rms_height}});
    return facts;
}

std::string left_out_in_a_line(const ChartData& data) {
    std::string line;
    for (const auto& [key, share] : left_out(data))
        line += (line.empty() ? std::to_string(data.left_out.size()) + " left out: " : ", ") +
                rough::name_of(key.second) + " from N = " + std::to_string(share.from) + " (" +
                why(data, key.first) + ")";
    return line;
}

} // namespace app
