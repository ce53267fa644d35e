#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/scan/scan.hpp"

namespace app {

/// The settings that say how to read a measured profile: unit, spacing, detrend, fill.
std::vector<Setting> scan_settings(const std::string& prefix = "");

/// Reads the scan. `nodes` resamples it to that many; 0 keeps its own number.
rough::Scan scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                      const std::string& prefix = "");

} // namespace app
