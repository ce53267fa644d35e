#include "apps/chart_page.hpp"

#include <algorithm>
#include <set>

namespace app {

namespace {

struct Look {
    const char* method;
    Colour colour;
};
constexpr Look looks[] = {{"nested", Colour::blue},
                          {"nnls", Colour::orange},
                          {"polonsky-keer", Colour::green},
                          {"active-set", Colour::purple}};

/// Points in order of x.
Series line_of(const std::string& label, std::vector<std::pair<double, double>> points, Colour colour,
               Style style, double width) {
    std::sort(points.begin(), points.end());
    Series series{label, Eigen::VectorXd(static_cast<Eigen::Index>(points.size())), {}, colour, style, width};
    series.y.resize(series.x.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        series.x[static_cast<Eigen::Index>(k)] = points[k].first;
        series.y[static_cast<Eigen::Index>(k)] = points[k].second;
    }
    return series;
}

/// Of (seconds, error), those that no other beats in both.
std::vector<std::pair<double, double>> pareto(std::vector<std::pair<double, double>> points) {
    std::sort(points.begin(), points.end());
    std::vector<std::pair<double, double>> front;
    for (const auto& point : points)
        if (front.empty() || point.second < front.back().second)
            front.push_back(point);
    return front;
}

} // namespace

Plot chart_plot(const ChartData& data, const std::string& scene, double ChartRun::*error,
                const std::string& label) {
    Plot plot;
    plot.alt = label + " against time per curve on the scene " + scene + ", one line a method";
    plot.title = scene;
    plot.x = {"Seconds per curve", true};
    plot.y = {label, true};
    std::vector<std::pair<double, double>> all;
    for (const Look& look : looks) {
        std::vector<std::pair<double, double>> points;
        for (const ChartRun& run : data.runs)
            if (run.scene == scene && run.method == look.method && run.outcome == Outcome::solved &&
                run.*error > 0)
                points.emplace_back(run.seconds, run.*error);
        all.insert(all.end(), points.begin(), points.end());
        plot.series.push_back(line_of("", points, look.colour, Style::points, 1.4));
        plot.series.push_back(line_of(look.method, pareto(points), look.colour, Style::line, 1.5));
    }
    plot.series.push_back(line_of("Pareto front", pareto(all), Colour::text, Style::points, 3));
    std::rotate(plot.series.begin(), plot.series.end() - 1, plot.series.end());
    return plot;
}

Plot nodes_plot(const ChartData& data) {
    Plot plot;
    plot.alt = "Time per curve against the number of nodes, one line a method";
    plot.title = "Growth with the grid";
    plot.x = {"Nodes N", true};
    plot.y = {"Seconds per curve", true};
    double most = 0;
    for (const ChartRun& run : data.growth)
        most = std::max(most, run.contact_fraction);
    for (const Look& look : looks) {
        std::vector<std::pair<double, double>> points;
        for (const ChartRun& run : data.growth)
            if (run.method == look.method && run.outcome == Outcome::solved &&
                run.contact_fraction > 0.7 * most)
                points.emplace_back(static_cast<double>(run.nodes), run.seconds);
        plot.series.push_back(line_of(look.method, points, look.colour, Style::line_points, 1.5));
    }
    return plot;
}

Plot contact_plot(const ChartData& data) {
    Plot plot;
    plot.alt = "Time per curve against the contact fraction, one line a method";
    plot.x = {"Contact fraction at the last step", true};
    plot.y = {"Seconds per curve", true};
    rough::Index shared = 0;
    std::set<rough::Index> sizes;
    for (const ChartRun& run : data.growth)
        sizes.insert(run.nodes);
    for (const rough::Index nodes : sizes)
        if (std::all_of(std::begin(looks), std::end(looks), [&](const Look& look) {
                return std::any_of(data.growth.begin(), data.growth.end(), [&](const ChartRun& run) {
                    return run.nodes == nodes && run.method == look.method && run.outcome == Outcome::solved;
                });
            }))
            shared = nodes;
    plot.title = "Growth with contact, N = " + std::to_string(shared);
    for (const Look& look : looks) {
        std::vector<std::pair<double, double>> points;
        for (const ChartRun& run : data.growth)
            if (run.method == look.method && run.outcome == Outcome::solved && run.nodes == shared)
                points.emplace_back(run.contact_fraction, run.seconds);
        plot.series.push_back(line_of(look.method, points, look.colour, Style::line_points, 1.5));
    }
    return plot;
}

} // namespace app
