#include "apps/experiments/chart/advice.hpp"

#include "apps/experiments/chart/words.hpp"
#include "apps/experiments/statistics.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace app {

using rough::Index;
using rough::Solver;

namespace {

/// Times of one method over those of another, at equal scenes and grids.
std::vector<double> ratios(const ChartData& data, Solver method, Solver other, Index nodes) {
    std::vector<double> ratios;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        const ChartRun *a = data.solved(usual_setting(scene, method, nodes)),
                       *b = data.solved(usual_setting(scene, other, nodes));
        if (a && b)
            ratios.push_back(a->seconds / b->seconds);
    }
    return ratios;
}

/// The finest grid on which both were measured on some scene, or 0.
Index finest_common(const ChartData& data, Solver method, Solver other) {
    Index finest = 0;
    for (const Index nodes : data.grids())
        if (!ratios(data, method, other, nodes).empty())
            finest = nodes;
    return finest;
}

std::string against(const ChartData& data, Solver method, Solver other) {
    std::string text;
    const Index finest = finest_common(data, method, other);
    for (const Index nodes : std::set<Index>{512, finest}) {
        const std::string range = range_words(ratios(data, method, other, nodes));
        if (!range.empty())
            text += (text.empty() ? "" : ", ") + range + " times as long as " + name_of(other) +
                    " at N = " + std::to_string(nodes);
    }
    return text;
}

/// Which of both was the faster at how many nodes in contact at the last step.
std::string words_of_crossing(const ChartData& data) {
    double nested_up_to = 0, active_from = HUGE_VAL;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const Index nodes : data.grids()) {
            const ChartRun *nested = data.solved(usual_setting(scene, Solver::nested, nodes)),
                           *active = data.solved(usual_setting(scene, Solver::active_set, nodes));
            if (!nested || !active)
                continue;
            const double touching = nested->contact_fraction * static_cast<double>(nodes);
            if (nested->seconds <= active->seconds)
                nested_up_to = std::max(nested_up_to, touching);
            else
                active_from = std::min(active_from, touching);
        }
    const auto nodes = [](double count) { return std::to_string(std::lround(count)) + " nodes"; };
    if (nested_up_to == 0 && std::isinf(active_from))
        return "";
    if (std::isinf(active_from))
        return " Nested was the faster of the two wherever both were measured, up to " + nodes(nested_up_to) +
               " touching.";
    if (nested_up_to <= active_from)
        return " Nested was the faster of the two with up to " + nodes(nested_up_to) +
               " touching at the last step, active-set with " + nodes(active_from) + " or more.";
    return " Nested was the faster of the two with less than " + nodes(active_from) +
           " touching at the last step, active-set with more than " + nodes(nested_up_to) +
           "; in between it depends on the grid, as a fine one with few in contact favours nested.";
}

} // namespace

std::string words_of_nested_and_active_set(const ChartData& data) {
    return "<b>nested</b> gives the exact solution of the grid, with every step's tangent. Its factor takes "
           "4 bytes for each pair of contact nodes, and its cost is that of contact: take it where few nodes "
           "touch, or on coarse grids. <b>active-set</b> needs no factor and keeps to its tolerance: take it "
           "where many nodes touch on a fine grid." +
           words_of_crossing(data);
}

std::string words_of_auto(const ChartData& data) {
    std::vector<double> losses;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const Index nodes : data.grids()) {
            const ChartRun *taken = data.solved(usual_setting(scene, Solver::automatic, nodes)),
                           *nested = data.solved(usual_setting(scene, Solver::nested, nodes)),
                           *active = data.solved(usual_setting(scene, Solver::active_set, nodes));
            if (taken && nested && active)
                losses.push_back(taken->seconds / std::min(nested->seconds, active->seconds));
        }
    std::string text = "<b>If in doubt take auto</b>, which is what you get without a word. It takes nested "
                       "or active-set by a fixed model of cost and memory, and says which.";
    if (!losses.empty())
        text += " Where both were measured here, auto took " + brief(median(losses), 3) +
                " times as long as the faster of the two in the median, and " +
                brief(*std::max_element(losses.begin(), losses.end()), 3) + " times at worst.";
    return text;
}

std::string words_of_others(const ChartData& data) {
    std::string text = "<b>nnls</b> adds one node at a time and finds the same solution as nested: it is "
                       "there as an independent check.";
    if (const std::string times = against(data, Solver::nnls, Solver::nested); !times.empty())
        text += " It took " + times + ".";
    text += " <b>polonsky-keer</b> needs no factor either and takes a load as well as a displacement.";
    if (const std::string times = against(data, Solver::polonsky_keer, Solver::active_set); !times.empty())
        text += " It took " + times + ".";
    return text;
}

std::string words_of_failures(const ChartData& data) {
    std::vector<std::string> failed;
    for (const ChartRun& run : data.runs)
        if (run.outcome != Outcome::solved && !run.late)
            failed.push_back(
                name_of(run.setting.method) + " on " + data.scenes[run.setting.scene].name +
                ", N = " + std::to_string(run.setting.nodes) +
                (run.setting.tolerance > 0 ? ", tolerance " + tolerance_word(run.setting.tolerance) : "") +
                " (" + name_of(run.outcome) + ")");
    return failed.empty() ? "Every method solved every setting that was tried and not stopped for its time."
                          : "Not solved: " + enumerated(failed) + ".";
}

} // namespace app
