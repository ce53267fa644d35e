#include "apps/experiments/chart/plan.hpp"

#include "apps/prompt/model_settings.hpp"
#include "domain/contact/names.hpp"

#include <algorithm>

namespace app {

using rough::Index;
using rough::Solver;

namespace {

bool is_iterative(Solver method) { return method == Solver::polonsky_keer || method == Solver::active_set; }

bool holds(const std::vector<Index>& grids, Index nodes) {
    return std::find(grids.begin(), grids.end(), nodes) != grids.end();
}

} // namespace

const ChartExtent& quick_extent() {
    static const ChartExtent extent{{128, 512, 2048}, {512, 2048}, {5, 80}, {1e-3, 1e-6}, 8193, 1};
    return extent;
}

const ChartExtent& whole_extent() {
    static const ChartExtent extent{{128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768, 65536},
                                    {512, 2048},
                                    {5, 10, 40, 80, 160},
                                    {1e-3, 1e-4, 1e-6, 1e-8},
                                    65537,
                                    5};
    return extent;
}

double usual_tolerance_of(Solver method) { return is_iterative(method) ? usual_tolerance : 0; }

ChartSetting usual_setting(std::size_t scene, Solver method, Index nodes) {
    return {scene, method, nodes, usual_steps, usual_tolerance_of(method)};
}

std::vector<ChartSetting> chart_plan(const ChartExtent& extent) {
    std::vector<ChartSetting> plan;
    for (const Index nodes : extent.nodes)
        for (std::size_t m = 0; m < rough::solver_names().size(); ++m) {
            const Solver method = static_cast<Solver>(m);
            for (const double tolerance : is_iterative(method) ? extent.tolerances : std::vector<double>{0})
                plan.push_back({0, method, nodes, usual_steps, tolerance});
            if (holds(extent.nodes_with_steps, nodes))
                for (const int steps : extent.steps)
                    plan.push_back({0, method, nodes, steps, usual_tolerance_of(method)});
        }
    return plan;
}

} // namespace app
