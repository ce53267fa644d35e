#pragma once

#include "apps/commands/design/run.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// Of a run whose answer was found, and verified where there was time.
Summary summary_of(const DesignRun& run);

/// Quantities that were not asked for, how far the answer is off from the scan's at most.
std::vector<std::pair<std::string, double>> off_unasked(const DesignRun& run);

/// `summary` of result.json.
nlohmann::json summary_json(const DesignRun& run);

} // namespace app
