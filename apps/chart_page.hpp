#pragma once

#include "apps/chart_growth.hpp"
#include "apps/plot.hpp"

namespace app {

/// All that a chart shows.
struct ChartData {
    std::vector<std::pair<std::string, std::string>>
        scenes;                   ///< name, and words: what it is and its reference
    std::vector<ChartRun> runs;   ///< at every setting
    std::vector<ChartRun> growth; ///< over grid sizes and contact fractions
};

/// Time against an error for a scene, log-log, one line a method, the Pareto front marked.
Plot chart_plot(const ChartData& data, const std::string& scene, double ChartRun::*error,
                const std::string& label);

/// Time against the nodes, and against the contact fraction on the finest grid that all methods share.
Plot nodes_plot(const ChartData& data);
Plot contact_plot(const ChartData& data);

/// A page that says in words which method to take when, with the pictures. Needs gnuplot.
std::string chart_page(const ChartData& data);

} // namespace app
