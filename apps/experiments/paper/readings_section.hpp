#pragma once

#include "apps/experiments/paper/readings.hpp"
#include "apps/report/page.hpp"

namespace app {

/// Adds the section on what rests on our reading of the paper, with what the other reading gives.
void add_readings(Page& page, const PaperRun& run, const Readings& readings);

} // namespace app
