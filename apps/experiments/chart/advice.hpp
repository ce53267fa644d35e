#pragma once

#include "apps/experiments/chart/data.hpp"

namespace app {

// Which method to take when, in sentences of HTML that hold for the runs that there are.

std::string words_of_auto(const ChartData& data);
std::string words_of_nested_and_active_set(const ChartData& data);
std::string words_of_others(const ChartData& data);
std::string words_of_failures(const ChartData& data);

} // namespace app
