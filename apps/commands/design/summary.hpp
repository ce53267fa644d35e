#pragma once

#include "apps/commands/design/run.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// Of a run whose answer was found, and verified where there was time.
Summary summary_of(const DesignRun& run);

/// `summary` of result.json.
nlohmann::json summary_json(const Summary& summary);

} // namespace app
