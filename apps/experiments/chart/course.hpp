#pragma once

#include "apps/experiments/chart/data.hpp"

namespace app {

/// What bounds a chart besides its extent, and who watches it.
struct ChartBounds {
    double seconds = 0;         ///< no setting begins that is not expected to end by then
    std::function<bool()> stop; ///< asked often where set; true ends the chart with what there is
    /// After each setting and reference: what there is, and words such as "12 of 740, about 3 min left".
    std::function<void(const ChartData&, const std::string&)> watch;
};

/// Works through the plan. The references and the coarsest grid are always done, and a setting that was begun
/// for one scene is tried on all of them. A scene's method that was too slow at a grid, or would be by its
/// own growth on the next, is not tried on finer ones with that tolerance. Whatever of the plan was not tried
/// is left_out.
ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent,
                  const ChartBounds& bounds);

} // namespace app
