#pragma once

#include "apps/experiments/chart/plan.hpp"

#include <map>
#include <tuple>

namespace app {

/// How long the curves of a chart take, and so how long those to come will: the same setting on finer grids
/// grows as it did between the last two.
class ChartPace {
  public:
    /// What settings that differ in their grids alone have in common.
    using Kind = std::tuple<std::size_t, rough::Solver, int, double, double>;
    static Kind kind(const ChartSetting& setting);

    void note(const ChartSetting& setting, double seconds);
    /// What a curve is expected to take, s.
    double expected(const ChartSetting& setting) const;
    /// The same for its place in the chart, where a short curve is solved a few times (run_chart), s.
    double expected_in_all(const ChartSetting& setting) const;

  private:
    std::map<Kind, std::map<rough::Index, double>> seconds_; ///< by nodes
};

} // namespace app
