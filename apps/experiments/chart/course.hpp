#pragma once

#include "apps/experiments/chart/data.hpp"

namespace app {

/// What bounds a chart besides its extent, and who watches it.
struct ChartBounds {
    double seconds = 0;          ///< of the wall's clock
    rough::Index finest_map = 0; ///< nodes a side of the maps that models are measured on; 0: none
    std::function<bool()> stop;  ///< asked often where set; true ends the chart with what there is
    /// After each setting and reference: what there is, and words such as "12 of 740, at most 3 min left".
    std::function<void(const ChartData&, const std::string&)> watch;
};

/// Works through the plan, one setting on all scenes before the next. The references and the coarsest grid
/// are always done; past its time a chart ends with the last setting that all scenes have. A curve takes at
/// least as many times its coarser grid's time as it has more nodes: what would take more than the limit by
/// that, or more than the time left, or was not solved on the coarser grid, is left out.
ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent,
                  const ChartBounds& bounds);

} // namespace app
