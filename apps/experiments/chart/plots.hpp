#pragma once

#include "apps/experiments/chart/data.hpp"
#include "apps/report/plot.hpp"

#include <array>

namespace app {

/// One of the errors that are charted.
struct ErrorKind {
    const char *name, *label;
    double ChartRun::*value;
    bool between_steps; ///< measured between the load steps too, so that more of them help

    /// Whether a run has it, in a way to be compared with other runs: of errors at the load steps alone, only
    /// those with the usual number of steps are.
    bool compares(const ChartRun& run) const {
        return run.*value != ChartRun::unknown && (between_steps || run.setting.steps == usual_steps);
    }
};
constexpr std::array<ErrorKind, 3> error_kinds{
    {{"pressure", "Error of the pressure", &ChartRun::error_pressure, false},
     {"stiffness", "Error of the stiffness", &ChartRun::error_stiffness, true},
     {"contact", "Error of the contact fraction", &ChartRun::error_contact, false}}};

/// Time against an error for a scene, log-log, one line a method, the Pareto front marked.
Plot error_plot(const ChartData& data, std::size_t scene, const ErrorKind& kind);

/// Time of a curve of 20 steps (tolerance 1e-6) against the nodes on a scene, log-log, one line a method.
Plot time_plot(const ChartData& data, std::size_t scene);

} // namespace app
