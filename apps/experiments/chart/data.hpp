#pragma once

#include "apps/experiments/chart/models.hpp"
#include "apps/experiments/chart/runs.hpp"
#include "apps/report/csv.hpp"

namespace app {

struct ChartedScene {
    std::string name, words, kernel;
    std::string reference; ///< what it is measured against
};

/// Why a setting was not tried.
enum class LeftOutFor {
    limit,    ///< one curve takes too long, to go by a coarser grid
    unsolved, ///< a coarser grid was refused or did not converge
    time,     ///< the chart's own time was over
    interrupt
};

struct LeftOut {
    ChartSetting setting;
    LeftOutFor why;
};

/// All that a chart shows.
struct ChartData {
    std::vector<ChartedScene> scenes; ///< a setting's scene is its place here
    std::vector<ChartRun> runs;       ///< in the order of the plan
    std::vector<LeftOut> left_out;    ///< the rest of the plan
    double limit = 0;                 ///< s that one curve might take
    ModelChart models;                ///< theories, lines and maps

    /// The run at a setting, or none.
    const ChartRun* at(const ChartSetting& setting) const;
    /// The same, or none if it was not solved.
    const ChartRun* solved(const ChartSetting& setting) const;
    /// A scene's contact fraction at its last step on the finest grid that was solved; 0 of none.
    double contact(std::size_t scene) const;
    /// The grids of the runs, increasing.
    std::vector<rough::Index> grids() const;
};

/// chart.csv: a row a run, of solvers and of models.
Csv chart_table(const ChartData& data);

} // namespace app
