#pragma once

#include "apps/experiments/chart/plots.hpp"
#include "apps/report/page.hpp"

namespace app {

/// The fastest method for a curve of 20 steps by scene and grid, and how much longer the next takes.
Table fastest_by_grid(const ChartData& data);

/// The fastest setting of each scene that keeps an error below levels.
Table fastest_by_error(const ChartData& data, const ErrorKind& kind);

/// What of the plan was not tried: a row a method and reason.
Table left_out_table(const ChartData& data);

/// The same in one line, for the end; "" where all was tried.
std::string left_out_in_a_line(const ChartData& data);

} // namespace app
