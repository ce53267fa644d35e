#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/scan/source.hpp"

namespace app {

/// The settings that say how to read a measured profile: unit, spacing, row, outliers, form,
/// filters, fill.
std::vector<Setting> scan_settings(const std::string& prefix = "");

/// Opens the scan. `nodes` resamples it to that many; 0 keeps its own number.
rough::Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                        const std::string& prefix = "");

/// Opens what --genome, or else --`scan`, names. Throws rough::InputError where settings of a scan are given
/// with a genome.
rough::Source source_from(const Settings& settings, rough::Index nodes, const std::string& scan = "profile");

} // namespace app
