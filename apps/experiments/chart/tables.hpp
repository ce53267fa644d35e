#pragma once

#include "apps/experiments/chart/data.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>

namespace app {

/// One of the errors that are charted.
struct ErrorKind {
    const char* name;
    double ChartRun::*value;
    bool between_steps; ///< also measured between the load steps, so that more of them help

    /// Whether a run has it, in a way to be compared with other runs: errors at the load steps only are
    /// compared for the usual number of steps.
    bool compares(const ChartRun& run) const {
        return run.*value != ChartRun::unknown && (between_steps || run.setting.steps == usual_steps);
    }
};
constexpr std::array<ErrorKind, 3> error_kinds{{{"pressure", &ChartRun::error_pressure, false},
                                                {"stiffness", &ChartRun::error_stiffness, true},
                                                {"contact", &ChartRun::error_contact, false}}};

/// points.csv: each run that has an error, by kind; `best` is 1 if no run of its method is faster and more
/// accurate, 2 if no run of any method is. Errors that differ by less than a twentieth count as equal.
Csv points_table(const ChartData& data);
/// model_errors.csv: the errors of each model over the loads, and its time.
Csv model_errors_table(const ModelChart& chart);
/// The fastest method for a curve of 20 steps by scene and grid, and how much longer the next one takes.
nlohmann::json fastest_by_grid(const ChartData& data);
/// The fastest setting of each scene that keeps an error below each of four levels.
nlohmann::json fastest_by_error(const ChartData& data, const ErrorKind& kind);
/// Settings that were not tried: a row for each method and reason.
nlohmann::json left_out_rows(const ChartData& data);
/// The same in one line, for the end; "" if all were tried.
std::string left_out_in_a_line(const ChartData& data);
/// Everything else that the page says: scenes, failures, and where theories, a line and a map hold.
nlohmann::json chart_facts(const ChartData& data);

} // namespace app
