#pragma once

#include "apps/experiments/chart/plan.hpp"
#include "apps/experiments/chart/scenes.hpp"
#include "apps/experiments/contact_trial.hpp"

#include <optional>

namespace app {

/// What became of a setting: a row of chart.csv.
struct ChartRun {
    ChartSetting setting;
    double seconds = 0; ///< of one curve, on one core: the least of a few
    double error_pressure = unknown, error_stiffness = unknown, error_contact = unknown;
    long iterations = 0;
    Outcome outcome = Outcome::solved;
    bool late = false;           ///< given up at the limit
    double contact_fraction = 0; ///< at the last step

    static constexpr double unknown = -1;
};

/// Pressure: relative errors at the curve's own displacements. Stiffness: relative errors of the tangent,
/// linear in between, at 20 pressures. Contact: errors of the contact fraction at the displacements. Root
/// mean squares.
void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run);

/// Solves a few times and takes the least time, as other work on the machine only adds to it; gives up after
/// `limit` seconds of processor time. Errors are known on grids that the truth resolves. None where `stop`
/// ended it.
std::optional<ChartRun> run_chart(const ChartScene& scene, const ChartTruth& truth,
                                  const ChartSetting& setting, double limit,
                                  const std::function<bool()>& stop = {});

} // namespace app
