#pragma once

#include "apps/experiments/chart/data.hpp"
#include "apps/report/page.hpp"

namespace app {

/// What of the plan was not tried, in one line for the end; "" where all was.
std::string left_out_in_a_line(const ChartData& data);

/// What of the plan was not tried and what was stopped at the limit: a row a method and reason.
Table left_out_table(const ChartData& data);

/// That the chart ended before its plan did, as HTML; "" where it did not.
std::string early_end(const ChartData& data);

} // namespace app
