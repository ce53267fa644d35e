#pragma once

#include "domain/contact/solve.hpp"

#include <compare>
#include <cstddef>
#include <vector>

namespace app {

/// What a chart tries once: a curve of a scene by a method.
struct ChartSetting {
    std::size_t scene = 0; ///< among chart_scenes()
    rough::Solver method = rough::Solver::nested;
    rough::Index nodes = 0;
    int steps = 0;
    double tolerance = 0; ///< 0 for the direct methods, which have none, and for auto, which takes 1e-6

    auto operator<=>(const ChartSetting&) const = default;
};

/// How fine and how patient a chart is.
struct ChartExtent {
    std::vector<rough::Index> nodes;            ///< with 20 load steps, increasing
    std::vector<rough::Index> nodes_with_steps; ///< of these, with other numbers of load steps too
    std::vector<int> steps;                     ///< those others
    std::vector<double> tolerances;             ///< of the iterative methods, 1e-6 among them
    rough::Index most_for_truth;                ///< nodes of a reference
    double limit;                               ///< s that one curve may take
};

const ChartExtent& quick_extent();
const ChartExtent& whole_extent();

constexpr int usual_steps = 20;
constexpr double usual_tolerance = 1e-6;
/// That a method has besides its grid: `usual_tolerance`, or 0 for a method without one.
double usual_tolerance_of(rough::Solver method);

/// 20 load steps, the usual tolerance.
ChartSetting usual_setting(std::size_t scene, rough::Solver method, rough::Index nodes);

/// Everything that a chart tries on each scene, from the coarsest grid to the finest.
std::vector<ChartSetting> chart_plan(const ChartExtent& extent);

} // namespace app
