#include "apps/experiments/chart/plots.hpp"

#include "apps/experiments/chart/growth.hpp"
#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"

#include <algorithm>

namespace app {

using rough::Index;
using rough::Solver;

namespace {

using Points = std::vector<std::pair<double, double>>;

struct Look {
    Solver method;
    Colour colour;
};
constexpr std::array<Look, 4> looks{{{Solver::nested, Colour::blue},
                                     {Solver::nnls, Colour::orange},
                                     {Solver::polonsky_keer, Colour::green},
                                     {Solver::active_set, Colour::purple}}};

/// Points in order of x.
Series line_of(const std::string& label, Points points, Colour colour, Style style, double width) {
    std::sort(points.begin(), points.end());
    Series series{label, Eigen::VectorXd(static_cast<Eigen::Index>(points.size())), {}, colour, style, width};
    series.y.resize(series.x.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        series.x[static_cast<Eigen::Index>(k)] = points[k].first;
        series.y[static_cast<Eigen::Index>(k)] = points[k].second;
    }
    return series;
}

/// Of (seconds, error), those that no other beats in both; an error counts as smaller where it is by a
/// twentieth, as methods that solve the same grid differ in their last digits.
Points pareto(Points points) {
    std::sort(points.begin(), points.end());
    Points front;
    for (const auto& point : points)
        if (front.empty() || point.second < 0.95 * front.back().second)
            front.push_back(point);
    return front;
}

Plot nodes_plot(const ChartData& data, std::size_t scene) {
    Plot plot;
    plot.alt =
        "Time per curve against the number of nodes on " + data.scenes[scene].name + ", one line a method";
    plot.title = data.scenes[scene].name + ", " + share_words(data.contact(scene)) + " in contact";
    plot.x = {"Nodes N", true};
    plot.y = {"Seconds per curve", true};
    for (const Look& look : looks) {
        Points points;
        for (const ChartRun& run : data.runs)
            if (run.setting.scene == scene && run.setting.method == look.method && run.setting.share == 1 &&
                counts_for_growth(run))
                points.emplace_back(static_cast<double>(run.setting.nodes), run.seconds);
        plot.series.push_back(line_of(name_of(look.method), points, look.colour, Style::line_points, 1.5));
    }
    return plot;
}

/// The finest grid on which every method has runs for a fit over contact fractions.
Index finest_shared(const ChartData& data) {
    Index shared = 0;
    for (const Index nodes : data.grids())
        if (std::all_of(looks.begin(), looks.end(), [&](const Look& look) {
                return std::count_if(data.runs.begin(), data.runs.end(), [&](const ChartRun& run) {
                           return run.setting.nodes == nodes && run.setting.method == look.method &&
                                  counts_for_growth(run);
                       }) > static_cast<long>(data.scenes.size());
            }))
            shared = nodes;
    return shared;
}

Plot contact_plot(const ChartData& data, Index nodes) {
    Plot plot;
    plot.alt = "Time per curve against the contact fraction, one colour a method";
    plot.title = "Every scene, N = " + std::to_string(nodes);
    plot.x = {"Contact fraction at the last step", true};
    plot.y = {"Seconds per curve", true};
    for (const Look& look : looks) {
        Points points;
        for (const ChartRun& run : data.runs)
            if (run.setting.method == look.method && run.setting.nodes == nodes && counts_for_growth(run))
                points.emplace_back(run.contact_fraction, run.seconds);
        plot.series.push_back(line_of(name_of(look.method), points, look.colour, Style::points, 2));
    }
    return plot;
}

} // namespace

Plot error_plot(const ChartData& data, std::size_t scene, const ErrorKind& kind) {
    Plot plot;
    plot.alt = std::string(kind.label) + " against time per curve on the scene " + data.scenes[scene].name +
               ", one line a method";
    plot.title = data.scenes[scene].name;
    plot.x = {"Seconds per curve", true};
    plot.y = {kind.label, true};
    Points all;
    for (const Look& look : looks) {
        Points points;
        for (const ChartRun& run : data.runs)
            if (run.setting.scene == scene && run.setting.method == look.method && kind.compares(run) &&
                run.*kind.value > 0)
                points.emplace_back(run.seconds, run.*kind.value);
        all.insert(all.end(), points.begin(), points.end());
        plot.series.push_back(line_of("", points, look.colour, Style::points, 1.4));
        plot.series.push_back(line_of(name_of(look.method), pareto(points), look.colour, Style::line, 1.5));
    }
    plot.series.push_back(line_of("", pareto(all), Colour::text, Style::points, 3));
    std::rotate(plot.series.begin(), plot.series.end() - 1, plot.series.end());
    return plot;
}

std::vector<std::pair<std::string, Plot>> growth_plots(const ChartData& data) {
    std::vector<std::size_t> scenes(data.scenes.size());
    for (std::size_t k = 0; k < scenes.size(); ++k)
        scenes[k] = k;
    const auto [fewest, most] =
        std::minmax_element(scenes.begin(), scenes.end(),
                            [&](std::size_t a, std::size_t b) { return data.contact(a) < data.contact(b); });
    std::vector<std::pair<std::string, Plot>> plots;
    plots.emplace_back("nodes-few", nodes_plot(data, *fewest));
    plots.emplace_back("nodes-most", nodes_plot(data, *most));
    if (const Index nodes = finest_shared(data); nodes > 0)
        plots.emplace_back("contact", contact_plot(data, nodes));
    return plots;
}

} // namespace app
