#pragma once

#include "apps/experiments/chart/data.hpp"

#include <string>

namespace app {

/// A page that says in words which method to take when, with the pictures. Needs gnuplot.
std::string chart_page(const ChartData& data);

} // namespace app
