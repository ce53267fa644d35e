#include "apps/experiments/chart/tables.hpp"

#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace app {

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

/// "nested, 0.2 ms", and on a line of its own the grid and what else was chosen.
Html setting_words(const ChartRun& run) {
    const ChartSetting& setting = run.setting;
    return name_of(setting.method) + ", " + time_words(run.seconds) +
           Html::raw("<span class=\"rule\">N = " + std::to_string(setting.nodes) + ", " +
                     std::to_string(setting.steps) + " steps" +
                     (setting.tolerance > 0 ? ", " + tolerance_word(setting.tolerance) : "") + "</span>");
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

} // namespace

Table fastest_by_grid(const ChartData& data) {
    std::vector<Index> grids;
    for (const Index nodes : data.grids())
        if (nodes >= 512 && (grids.empty() || nodes >= 4 * grids.back()))
            grids.push_back(nodes);
        else if (grids.size() > 1 && nodes == data.grids().back())
            grids.back() = nodes;
    Table table{"Fastest method for a curve of 20 steps (tolerance 1e-6), and how much longer the next takes",
                {"Scene", "In contact"},
                {},
                {false, true}};
    for (const Index nodes : grids)
        table.header.push_back("N = " + std::to_string(nodes));
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        std::vector<Html> row{data.scenes[scene].name, share_words(data.contact(scene))};
        for (const Index nodes : grids) {
            const auto runs = ranked(data, scene, nodes);
            Html cell = runs.empty() ? "not tried" : "";
            if (!runs.empty())
                cell = name_of(runs[0]->setting.method) + ", " + time_words(runs[0]->seconds);
            if (runs.size() > 1) {
                const double longer = runs[1]->seconds / runs[0]->seconds;
                cell += Html::raw("<span class=\"rule\">") + name_of(runs[1]->setting.method) +
                        (longer < same_time ? " alike" : " " + brief(longer) + " times") +
                        Html::raw("</span>");
            }
            row.push_back(cell);
        }
        table.rows.push_back(row);
    }
    return table;
}

Table fastest_by_error(const ChartData& data, const ErrorKind& kind) {
    Table table{"Fastest setting for an error of the " + std::string(kind.name) + " of at most" +
                    (kind.between_steps ? "" : ", of those with 20 load steps"),
                {"Scene"},
                {}};
    const std::vector<double> levels{0.03, 0.01, 1e-3, 1e-4};
    for (const double level : levels)
        table.header.push_back(share_words(level));
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        std::vector<Html> row{data.scenes[scene].name};
        for (const double level : levels) {
            std::vector<const ChartRun*> runs;
            for (const ChartRun& run : data.runs) // auto stands for what it takes
                if (run.setting.scene == scene && run.setting.method != Solver::automatic &&
                    kind.compares(run) && run.*kind.value <= level)
                    runs.push_back(&run);
            fastest_first(runs);
            row.push_back(runs.empty() ? Html("none of the settings tried") : setting_words(*runs.front()));
        }
        table.rows.push_back(row);
    }
    return table;
}

Table left_out_table(const ChartData& data) {
    Table table{"", {"Method", "Settings left out", "From the grid", "Why"}, {}, {false, true, false, false}};
    for (const auto& [key, share] : left_out(data))
        table.rows.push_back({name_of(key.second), std::to_string(share.settings),
                              "N = " + std::to_string(share.from), why(data, key.first)});
    return table;
}

std::string left_out_in_a_line(const ChartData& data) {
    std::string line;
    for (const auto& [key, share] : left_out(data))
        line += (line.empty() ? std::to_string(data.left_out.size()) + " left out: " : ", ") +
                name_of(key.second) + " from N = " + std::to_string(share.from) + " (" +
                why(data, key.first) + ")";
    return line;
}

} // namespace app
