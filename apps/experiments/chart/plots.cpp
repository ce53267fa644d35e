#include "apps/experiments/chart/plots.hpp"

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

Plot time_plot(const ChartData& data, std::size_t scene) {
    Plot plot;
    plot.alt =
        "Time per curve against the number of nodes on " + data.scenes[scene].name + ", one line a method";
    plot.title = data.scenes[scene].name + ", " + share_words(data.contact(scene)) + " in contact";
    plot.x = {"Nodes N", true};
    plot.y = {"Seconds per curve", true};
    for (const Look& look : looks) {
        Points points;
        for (const Index nodes : data.grids())
            if (const ChartRun* run = data.solved(usual_setting(scene, look.method, nodes)))
                points.emplace_back(static_cast<double>(nodes), run->seconds);
        plot.series.push_back(line_of(name_of(look.method), points, look.colour, Style::line_points, 1.5));
    }
    return plot;
}

} // namespace app
