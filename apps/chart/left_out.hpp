#pragma once

#include "apps/chart/data.hpp"
#include "apps/report/page.hpp"

namespace app {

/// What of the plan was not tried, in one line for the end; "" where all was.
std::string left_out_in_a_line(const ChartData& data);

/// The same in full, and with what was stopped at the limit: a row a method and reason.
Table left_out_table(const ChartData& data);

} // namespace app
