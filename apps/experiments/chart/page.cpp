#include "apps/experiments/chart/page.hpp"

#include "apps/experiments/chart/accuracy.hpp"
#include "apps/experiments/chart/advice.hpp"
#include "apps/experiments/chart/fastest.hpp"
#include "apps/experiments/chart/growth.hpp"
#include "apps/experiments/chart/left_out.hpp"
#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/plot_svg.hpp"
#include "apps/report/units.hpp"

#include <algorithm>

namespace app {

namespace {

Table growth_table(const ChartData& data) {
    Table table{
        "Time of a curve of 20 load steps, tolerance 1e-6: N nodes, of which m, a share f, touch at the last "
        "step",
        {"Method", "Time", "off by a factor of", "runs"},
        {},
        {false, false, true, true}};
    for (const rough::Solver method : {rough::Solver::nested, rough::Solver::nnls,
                                       rough::Solver::polonsky_keer, rough::Solver::active_set}) {
        const Growth growth = fitted_growth(method, data.runs);
        table.rows.push_back({name_of(method), growth.law, growth.spread > 0 ? brief(growth.spread, 3) : "–",
                              std::to_string(growth.runs)});
    }
    return table;
}

Figure figure_of(const ChartData& data, const ErrorKind& kind) {
    Figure figure{kind.name,
                  std::string(kind.label) + " against time.",
                  std::string("Each dot is a grid") +
                      (kind.between_steps ? ", a number of load steps and a tolerance"
                                          : " and a tolerance, with 20 load steps") +
                      "; lines join a method's best, and black rings mark what nothing beats in both.",
                  {}};
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        figure.panels.push_back(error_plot(data, scene, kind));
    return figure;
}

} // namespace

std::string chart_page(const ChartData& data) {
    Page page("Speed against accuracy",
              "Which contact method to take when: time of one pressure curve on one core against its error.");
    if (const std::string words = early_end(data); !words.empty())
        page.prose(words);
    page.section("Which method when");
    page.prose(words_of_auto(data));
    page.prose(words_of_nested_and_active_set(data));
    page.table(fastest_by_grid(data));
    page.prose(words_of_others(data));
    page.prose(words_of_failures(data));
    page.section("How fine");
    if (const std::string words = accuracy_in_words(data); !words.empty())
        page.prose(words);
    for (const ErrorKind* kind : {&error_kinds[0], &error_kinds[1]})
        page.table(fastest_by_error(data, *kind));
    page.table(what_limits(data));
    page.section("Error against time");
    for (const ErrorKind& kind : error_kinds)
        page.figure(figure_of(data, kind));
    page.section("Growth of cost");
    Figure growth{
        "growth",
        "Time of a curve of 20 load steps, tolerance 1e-6.",
        "Where the fewest and where the most nodes touch, and over the contact fraction: the direct "
        "methods' time is that of contact, the iterative ones' that of the grid.",
        {}};
    for (auto& [name, plot] : growth_plots(data))
        growth.panels.push_back(std::move(plot));
    page.figure(std::move(growth));
    page.table(growth_table(data));
    page.section("What was left out");
    if (const Table left_out = left_out_table(data); left_out.rows.empty()) {
        page.prose("Nothing: all " + std::to_string(data.runs.size()) + " settings were tried.");
    } else {
        const auto late =
            std::count_if(data.runs.begin(), data.runs.end(), [](const ChartRun& run) { return run.late; });
        page.prose(std::to_string(data.left_out.size()) + " of " +
                   std::to_string(data.left_out.size() + data.runs.size()) +
                   " settings were not tried, and " + std::to_string(late) +
                   " were begun and stopped. All others are in the pictures.");
        page.table(left_out);
    }
    page.section("What was measured");
    for (const ChartedScene& scene : data.scenes)
        page.prose("<b>" + scene.name + "</b>: " + escaped(scene.words) + "; measured against " +
                   escaped(scene.reference) + ".");
    page.prose(
        "Errors are root mean squares: of the relative error of the pressure over the load steps, at the "
        "same displacement; of the relative error of the tangent stiffness at 20 pressures, linear "
        "between the load steps; of the error of the contact fraction over the load steps. Times are "
        "those of one core, the least of a few solutions, certificates included.");
    return page.html();
}

} // namespace app
