#include "apps/chart_page.hpp"

#include "apps/model_settings.hpp"
#include "apps/plot_svg.hpp"
#include "apps/report/page.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace app {

namespace {

std::string number(double value, int digits = 2) {
    std::ostringstream out;
    out.precision(digits);
    out << value;
    return out.str();
}

std::string time_words(double seconds) {
    return seconds < 1e-3 ? number(1e6 * seconds, 3) + " µs"
           : seconds < 1  ? number(1e3 * seconds, 3) + " ms"
                          : number(seconds, 3) + " s";
}

std::string share_words(double error) { return number(100 * error) + " %"; }

/// The fastest solved run of a scene that keeps an error, or none. `auto` stands for what it takes.
const ChartRun* fastest(const ChartData& data, const std::string& scene, double ChartRun::*error,
                        double most) {
    const ChartRun* best = nullptr;
    for (const ChartRun& run : data.runs)
        if (run.scene == scene && run.method != "auto" && run.outcome == Outcome::solved &&
            run.*error != ChartRun::unknown && run.*error <= most && (!best || run.seconds < best->seconds))
            best = &run;
    return best;
}

Table advice(const ChartData& data, double ChartRun::*error, const std::string& what) {
    Table table{"Fastest setting for an error of the " + what + " of at most", {"Scene"}, {}};
    const std::vector<double> levels{0.03, 0.01, 1e-3, 1e-4};
    for (const double level : levels)
        table.header.push_back(share_words(level));
    for (const auto& [scene, words] : data.scenes) {
        std::vector<std::string> row{scene};
        for (const double level : levels) {
            const ChartRun* best = fastest(data, scene, error, level);
            row.push_back(best ? best->method + ", N = " + std::to_string(best->nodes) + ", " +
                                     std::to_string(best->steps) + " steps: " + time_words(best->seconds)
                               : "none of the settings tried");
        }
        table.rows.push_back(row);
    }
    return table;
}

std::vector<Growth> growths(const ChartData& data) {
    std::vector<Growth> all;
    for (const std::string& method : solver_names())
        if (const Growth growth = fitted_growth(method, data.growth); growth.factor > 0 && method != "auto")
            all.push_back(growth);
    return all;
}

Table growth_table(const std::vector<Growth>& growths) {
    Table table{"Cost of a curve of 20 steps: seconds = c N^a f^b, f the contact fraction at the last step",
                {"Method", "c", "a", "b", "runs"},
                {},
                {false, true, true, true, true}};
    for (const Growth& growth : growths)
        table.rows.push_back({growth.method, number(growth.factor), number(growth.by_nodes, 3),
                              number(growth.by_contact, 3), std::to_string(growth.runs)});
    return table;
}

/// How much longer another method takes than nested, the median over equal settings.
std::string against_nested(const ChartData& data, const std::string& method, rough::Index nodes) {
    std::vector<double> ratios;
    for (const ChartRun& run : data.runs)
        for (const ChartRun& nested : data.runs)
            if (run.method == method && nested.method == "nested" && run.nodes == nodes &&
                nested.nodes == nodes && run.scene == nested.scene && run.steps == nested.steps &&
                run.outcome == Outcome::solved && nested.outcome == Outcome::solved)
                ratios.push_back(run.seconds / nested.seconds);
    if (ratios.empty())
        return "";
    std::sort(ratios.begin(), ratios.end());
    return number(ratios[ratios.size() / 2], 3);
}

/// The number of nodes from which the active set is faster than the nested factor, by the fits.
std::string crossing(const std::vector<Growth>& growths, double fraction) {
    const Growth *nested = nullptr, *iterative = nullptr;
    for (const Growth& growth : growths) {
        if (growth.method == "nested")
            nested = &growth;
        if (growth.method == "active-set")
            iterative = &growth;
    }
    if (!nested || !iterative || nested->by_nodes <= iterative->by_nodes)
        return "";
    const double nodes = std::exp((std::log(iterative->factor / nested->factor) +
                                   (iterative->by_contact - nested->by_contact) * std::log(fraction)) /
                                  (nested->by_nodes - iterative->by_nodes));
    constexpr double largest_grid = 1e7;
    return nodes < largest_grid ? number(nodes, 2) : "";
}

std::string failures(const ChartData& data) {
    std::string text;
    for (const ChartRun& run : data.runs)
        if (run.outcome != Outcome::solved)
            text += (text.empty() ? "" : "; ") + run.method + " on " + run.scene +
                    ", N = " + std::to_string(run.nodes) + ": " + name_of(run.outcome);
    return text;
}

std::vector<std::string> choice_in_words(const ChartData& data, const std::vector<Growth>& growths) {
    std::vector<std::string> words;
    std::string first =
        "<b>Take nested</b> wherever its factor fits: it gives the exact solution of the grid, with "
        "every step's tangent, and is the fastest.";
    for (const std::string method : {"nnls", "polonsky-keer", "active-set"})
        if (const std::string ratio = against_nested(data, method, 512); !ratio.empty())
            first += " At N = 512 " + method + " takes " + ratio + " times as long (median over the scenes).";
    words.push_back(first);
    const std::string few = crossing(growths, 0.05), many = crossing(growths, 0.3);
    const std::string overtakes =
        few.empty() || many.empty()
            ? "where the factor does not fit: on the grids tried here it does not overtake nested"
            : "on finer grids: by the fits below it overtakes nested at about " + few +
                  " nodes when 5 % touch, and at about " + many + " when 30 % do";
    words.push_back(
        "<b>Take active-set</b> " + overtakes +
        "; nested's factor takes 4 bytes for each pair of contact nodes. <b>auto</b> decides by a fixed "
        "model of cost and memory and says what it took.");
    words.push_back(
        "<b>NNLS</b> adds one node at a time and finds the same solution more slowly; it is there as an "
        "independent check. <b>Polonsky-Keer</b> needs no factor either and takes a load as well as a "
        "displacement, but slows down on fine grids and near full contact.");
    words.push_back(
        "A tolerance of 1e-3 saves an iterative solver little, since the contact set has to be right for the "
        "stiffness to be: refine the grid first, then the load steps, and the tolerance last.");
    const std::string failed = failures(data);
    words.push_back(failed.empty() ? "Every method solved every setting tried."
                                   : "Not solved: " + failed + ".");
    return words;
}

Figure figure_of(const ChartData& data, const std::string& id, double ChartRun::*error,
                 const std::string& label) {
    Figure figure{id,
                  label + " against time.",
                  "Each point a grid, a number of load steps and a tolerance; lines join a method's best, "
                  "large dots are "
                  "those that nothing beats in both.",
                  {}};
    for (const auto& scene : data.scenes)
        figure.panels.push_back(chart_plot(data, scene.first, error, label));
    return figure;
}

} // namespace

std::string chart_page(const ChartData& data) {
    Page page("Speed against accuracy",
              "Which contact method to take when: time of one pressure curve on one core against its error.");
    const std::vector<Growth> fits = growths(data);
    page.section("Which method when");
    for (const std::string& words : choice_in_words(data, fits))
        page.prose(words);
    page.table(advice(data, &ChartRun::error_pressure, "pressure"));
    page.table(advice(data, &ChartRun::error_stiffness, "stiffness"));
    page.section("Error against time");
    page.figure(figure_of(data, "pressure", &ChartRun::error_pressure, "Error of the pressure"));
    page.figure(figure_of(data, "stiffness", &ChartRun::error_stiffness, "Error of the stiffness"));
    page.figure(figure_of(data, "contact", &ChartRun::error_contact, "Error of the contact fraction"));
    if (!data.growth.empty()) {
        page.section("Growth of cost");
        page.figure({"growth",
                     "Time of a curve of 20 steps.",
                     "On the rough MWM profile.",
                     {nodes_plot(data), contact_plot(data)}});
        page.table(growth_table(fits));
    }
    page.section("What was measured");
    for (const auto& [scene, words] : data.scenes)
        page.prose("<b>" + scene + "</b>: " + escaped(words) + ".");
    page.prose("Errors are root mean squares: of the relative error of the pressure over the load steps, at "
               "the same "
               "displacement; of the relative error of the tangent stiffness at 20 pressures, linear between "
               "the load "
               "steps; of the error of the contact fraction over the load steps. Times are those of one "
               "core, medians of "
               "a few solutions, certificates included.");
    return page.html();
}

} // namespace app
