#pragma once

#include "apps/chart_scenes.hpp"
#include "apps/contact_trial.hpp"

namespace app {

/// One method at one setting on one scene: what chart.csv has in a row.
struct ChartRun {
    std::string scene, kernel, method;
    rough::Index nodes = 0;
    int steps = 0;
    double tolerance = 0; ///< 0 for the direct methods, which have none
    double seconds = 0;   ///< of one curve, on one core: the median of a few
    double error_pressure = unknown, error_stiffness = unknown, error_contact = unknown;
    long iterations = 0;
    Outcome outcome = Outcome::solved;
    double contact_fraction = 0; ///< at the last step

    static constexpr double unknown = -1;
};

/// Pressure: relative errors at the curve's own displacements. Stiffness: relative errors of the tangent,
/// linear in between, at 20 pressures. Contact: errors of the contact fraction at the displacements. Root
/// mean squares.
void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run);

/// Solves a few times and takes the median time; gives up after `limit` seconds.
ChartRun run_chart(const ChartScene& scene, const ChartTruth* truth, rough::Solver method, rough::Index nodes,
                   int steps, double tolerance, double limit, double share = 1);

std::string chart_csv(const std::vector<ChartRun>& runs);

} // namespace app
