#include "apps/experiments/chart/fastest.hpp"

#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <array>

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
std::string setting_words(const ChartRun& run) {
    const ChartSetting& setting = run.setting;
    return name_of(setting.method) + ", " + time_words(run.seconds) +
           "<span class=\"rule\">N = " + std::to_string(setting.nodes) + ", " +
           std::to_string(setting.steps) + " steps" +
           (setting.tolerance > 0 ? ", " + tolerance_word(setting.tolerance) : "") + "</span>";
}

/// The coarsest grid from which on active-set was always faster than nested.
std::string overtaken_at(const ChartData& data, std::size_t scene) {
    Index from = 0, both = 0;
    for (const Index nodes : data.grids()) {
        const ChartRun *nested = data.solved(usual_setting(scene, Solver::nested, nodes)),
                       *active = data.solved(usual_setting(scene, Solver::active_set, nodes));
        if (!nested || !active)
            continue;
        both = nodes;
        if (active->seconds >= nested->seconds)
            from = 0;
        else if (from == 0)
            from = nodes;
    }
    return from > 0 ? "N = " + std::to_string(from) : both > 0 ? "beyond N = " + std::to_string(both) : "–";
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
    table.header.push_back("Active-set overtakes at");
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        std::vector<std::string> row{data.scenes[scene].name, share_words(data.contact(scene))};
        for (const Index nodes : grids) {
            const auto runs = ranked(data, scene, nodes);
            std::string cell = runs.empty() ? "not tried" : "";
            if (!runs.empty())
                cell = name_of(runs[0]->setting.method) + ", " + time_words(runs[0]->seconds);
            if (runs.size() > 1) {
                const double longer = runs[1]->seconds / runs[0]->seconds;
                cell += "<span class=\"rule\">" + name_of(runs[1]->setting.method) +
                        (longer < same_time ? " alike" : " " + brief(longer) + " times") + "</span>";
            }
            row.push_back(cell);
        }
        row.push_back(overtaken_at(data, scene));
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
        std::vector<std::string> row{data.scenes[scene].name};
        for (const double level : levels) {
            std::vector<const ChartRun*> runs;
            for (const ChartRun& run : data.runs) // auto stands for what it takes
                if (run.setting.scene == scene && run.setting.method != Solver::automatic &&
                    kind.compares(run) && run.*kind.value <= level)
                    runs.push_back(&run);
            fastest_first(runs);
            row.push_back(runs.empty() ? "none of the settings tried" : setting_words(*runs.front()));
        }
        table.rows.push_back(row);
    }
    return table;
}

} // namespace app
