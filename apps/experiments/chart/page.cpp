#include "apps/experiments/chart/tables.hpp"
#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>

namespace app {

using rough::Solver;

namespace {

/// How much longer auto took than the faster of the two it takes from.
std::string losses_of_auto(const ChartData& data) {
    std::vector<double> losses;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const rough::Index nodes : data.grids()) {
            const ChartRun *taken = data.solved(usual_setting(scene, Solver::automatic, nodes)),
                           *nested = data.solved(usual_setting(scene, Solver::nested, nodes)),
                           *active = data.solved(usual_setting(scene, Solver::active_set, nodes));
            if (taken && nested && active)
                losses.push_back(taken->seconds / std::min(nested->seconds, active->seconds));
        }
    return losses.empty()
               ? ""
               : " Where both were measured here, auto took " + brief(rough::median(losses), 3) +
                     " times as long as the faster of the two in the median, and " +
                     brief(*std::max_element(losses.begin(), losses.end()), 3) + " times at worst.";
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

/// That the chart ended before its plan did, or nothing.
void add_early_end(Page& page, const ChartData& data) {
    const auto first = std::find_if(data.left_out.begin(), data.left_out.end(), [](const LeftOut& each) {
        return each.why == LeftOutFor::time || each.why == LeftOutFor::interrupt;
    });
    if (first != data.left_out.end())
        page.prose(Html::raw("<b>This chart ended early</b>, on grids of " +
                             std::to_string(first->setting.nodes) + " nodes, as " +
                             (first->why == LeftOutFor::time ? "its time was over" : "it was interrupted") +
                             ". What follows holds for what was measured."));
}

void add_advice(Page& page, const ChartData& data) {
    page.section("Which method when");
    page.prose(
        Html::raw("<b>If in doubt take auto</b>, which is what you get without a word. It takes nested or "
                  "active-set by a fixed model of cost and memory, and says which." +
                  losses_of_auto(data)));
    page.prose(Html::raw(
        "<b>nested</b> gives the exact solution of the grid, with every step's tangent. Its factor takes "
        "4 bytes for each pair of contact nodes, and its cost is that of contact: take it where few "
        "nodes touch, or on coarse grids. <b>active-set</b> needs no factor and keeps to its "
        "tolerance: take it where many nodes touch on a fine grid. <b>nnls</b> adds one node at a time "
        "and finds the same solution as nested: it is there as an independent check. "
        "<b>polonsky-keer</b> needs no factor either and takes a load as well as a displacement."));
    page.table(fastest_by_grid(data));
    page.prose(words_of_failures(data));
    page.section("How fine");
    for (const ErrorKind* kind : {&error_kinds[0], &error_kinds[1]})
        page.table(fastest_by_error(data, *kind));
}

void add_pictures(Page& page, const ChartData& data) {
    page.section("Error against time");
    for (const ErrorKind& kind : error_kinds) {
        Figure figure{kind.name,
                      std::string(kind.label) + " against time.",
                      std::string("Each dot is a grid") +
                          (kind.between_steps ? ", a number of load steps and a tolerance"
                                              : " and a tolerance, with 20 load steps") +
                          "; lines join a method's best, and black rings mark what nothing beats in both.",
                      {}};
        for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
            figure.panels.push_back(error_plot(data, scene, kind));
        page.figure(std::move(figure));
    }
    Figure times{
        "time",
        "Time of a curve of 20 load steps, tolerance 1e-6.",
        "The direct methods' time grows with the nodes in contact, the iterative ones' with the grid.",
        {}};
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        times.panels.push_back(time_plot(data, scene));
    page.figure(std::move(times));
}

void add_left_out(Page& page, const ChartData& data) {
    page.section("What was left out");
    const auto late =
        std::count_if(data.runs.begin(), data.runs.end(), [](const ChartRun& run) { return run.late; });
    page.prose(std::to_string(data.left_out.size()) + " of " +
               std::to_string(data.left_out.size() + data.runs.size()) + " settings were not tried, and " +
               std::to_string(late) + " were begun and stopped after " + brief(data.limit, 3) + " s.");
    if (!data.left_out.empty())
        page.table(left_out_table(data));
}

} // namespace

std::string chart_page(const ChartData& data) {
    Page page("Speed against accuracy",
              "Which model and which method to take when: time of one curve on one core against its error.");
    add_early_end(page, data);
    add_models(page, data.models);
    add_advice(page, data);
    add_pictures(page, data);
    add_left_out(page, data);
    page.section("What was measured");
    const auto tell = [&](const auto& scenes) {
        for (const auto& scene : scenes)
            page.prose(strong(scene.name) + ": " + scene.words + "; measured against " + scene.reference +
                       ".");
    };
    tell(data.scenes);
    tell(data.models.scenes);
    page.prose(
        "Errors are root mean squares: of the relative error of the pressure over the load steps, at the "
        "same displacement; of the relative error of the tangent stiffness at 20 pressures, linear "
        "between the load steps; of the error of the contact fraction over the load steps. Times are "
        "those of one core, the least of a few solutions, certificates included.");
    return page.html();
}

} // namespace app
