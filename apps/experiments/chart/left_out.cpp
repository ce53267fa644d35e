#include "apps/experiments/chart/left_out.hpp"

#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace app {

using rough::Index;
using rough::Solver;

namespace {

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

std::string left_out_in_a_line(const ChartData& data) {
    std::map<LeftOutFor, std::map<Solver, Index>> first; // grid
    for (const LeftOut& each : data.left_out) {
        const auto [found, is_new] = first[each.why].emplace(each.setting.method, each.setting.nodes);
        if (!is_new)
            found->second = std::min(found->second, each.setting.nodes);
    }
    std::string line;
    for (const auto& [reason, methods] : first) {
        std::vector<std::string> words;
        for (const auto& [method, nodes] : methods)
            words.push_back(name_of(method) + " from N = " + std::to_string(nodes));
        line += (line.empty() ? std::to_string(data.left_out.size()) + " left out: " : "; ") +
                enumerated(words) + " (" + why(data, reason) + ")";
    }
    return line;
}

std::string early_end(const ChartData& data) {
    const auto first = std::find_if(data.left_out.begin(), data.left_out.end(), [](const LeftOut& each) {
        return each.why == LeftOutFor::time || each.why == LeftOutFor::interrupt;
    });
    return first == data.left_out.end()
               ? ""
               : "<b>This chart ended early</b>, on grids of " + std::to_string(first->setting.nodes) +
                     " nodes, as " +
                     (first->why == LeftOutFor::time ? "its time was over" : "it was interrupted") +
                     ". What follows holds for what was measured.";
}

Table left_out_table(const ChartData& data) {
    // By method, reason and tolerance: the scenes of each grid, and by those the tolerances that share them.
    std::map<std::tuple<Solver, LeftOutFor, double>, std::map<Index, std::set<std::size_t>>> grids;
    const auto add = [&](const ChartSetting& setting, LeftOutFor reason) {
        grids[{setting.method, reason, setting.tolerance}][setting.nodes].insert(setting.scene);
    };
    for (const LeftOut& each : data.left_out)
        add(each.setting, each.why);
    for (const ChartRun& run : data.runs)
        if (run.late)
            add(run.setting, LeftOutFor::limit);
    std::map<std::tuple<Solver, LeftOutFor, std::string>, std::vector<std::string>> tolerances;
    for (const auto& [key, by_grid] : grids) {
        const auto& [method, reason, tolerance] = key;
        std::map<std::set<std::size_t>, std::vector<std::string>> by_scenes;
        for (const auto& [nodes, scenes] : by_grid)
            by_scenes[scenes].push_back(std::to_string(nodes));
        std::string where;
        for (const auto& [scenes, nodes] : by_scenes) {
            std::vector<std::string> names;
            for (const std::size_t scene : scenes)
                names.push_back(data.scenes[scene].name);
            where += (where.empty() ? "N = " : "; N = ") + enumerated(nodes) + " on " +
                     (scenes.size() == data.scenes.size() ? "every scene" : enumerated(names));
        }
        auto& shared = tolerances[{method, reason, where}];
        if (tolerance > 0)
            shared.push_back(tolerance_word(tolerance));
    }
    Table table{"", {"Method", "Tolerance", "Left out", "Why"}, {}, {}, true};
    for (const auto& [key, words] : tolerances) {
        const auto& [method, reason, where] = key;
        table.rows.push_back(
            {name_of(method), words.empty() ? "none" : enumerated(words), where, why(data, reason)});
    }
    return table;
}

} // namespace app
