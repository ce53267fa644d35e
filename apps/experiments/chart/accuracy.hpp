#pragma once

#include "apps/experiments/chart/data.hpp"
#include "apps/report/page.hpp"

namespace app {

/// What a finer grid, more load steps and a looser tolerance do to a scene's errors.
Table what_limits(const ChartData& data);

/// The same in words, over all scenes; "" where it was not measured.
std::string accuracy_in_words(const ChartData& data);

} // namespace app
