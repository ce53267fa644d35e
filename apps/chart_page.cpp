#include "apps/chart_page.hpp"

#include "apps/chart_accuracy.hpp"
#include "apps/chart_advice.hpp"
#include "apps/chart_fastest.hpp"
#include "apps/chart_growth.hpp"
#include "apps/chart_left_out.hpp"
#include "apps/chart_words.hpp"
#include "apps/model_settings.hpp"
#include "apps/plot_svg.hpp"

namespace app {

namespace {

Table growth_table(const ChartData& data) {
    Table table{
        "Seconds of a curve of 20 steps as c N<sup>a</sup> f<sup>b</sup>, f the contact fraction at the "
        "last step",
        {"Method", "c", "a", "b", "runs", "off by a factor of"},
        {},
        {false, true, true, true, true, true}};
    for (const std::string& name : solver_names()) {
        const auto method = static_cast<rough::Solver>(table.rows.size());
        const Growth growth = fitted_growth(method, data.runs);
        table.rows.push_back(
            growth.factor > 0
                ? std::vector<std::string>{name, number(growth.factor), number(growth.by_nodes, 3),
                                           number(growth.by_contact, 3), std::to_string(growth.runs),
                                           number(growth.spread, 3)}
                : std::vector<std::string>{name, "–", "–", "–", std::to_string(growth.runs), "–"});
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
    Figure growth{"growth", "Time of a curve of 20 steps, tolerance 1e-6.", "", {}};
    for (auto& [name, plot] : growth_plots(data))
        growth.panels.push_back(std::move(plot));
    page.figure(std::move(growth));
    page.table(growth_table(data));
    page.section("What was left out");
    if (data.left_out.empty())
        page.prose("Nothing: all " + std::to_string(data.runs.size()) + " settings were tried.");
    else {
        page.prose(std::to_string(data.left_out.size()) + " of " +
                   std::to_string(data.left_out.size() + data.runs.size()) + " settings.");
        page.table(left_out_table(data));
    }
    page.section("What was measured");
    for (const ChartedScene& scene : data.scenes)
        page.prose("<b>" + scene.name + "</b>: " + escaped(scene.words) + "; measured against " +
                   escaped(scene.reference) + ".");
    page.prose(
        "Errors are root mean squares: of the relative error of the pressure over the load steps, at the "
        "same displacement; of the relative error of the tangent stiffness at 20 pressures, linear "
        "between the load steps; of the error of the contact fraction over the load steps. Times are "
        "those of one core, medians of a few solutions, certificates included.");
    return page.html();
}

} // namespace app
