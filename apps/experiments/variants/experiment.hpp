#pragma once

#include "apps/experiments/variants/run.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/settings.hpp"

#include <atomic>
#include <filesystem>

namespace app {

/// The keys that experiments/variants.ini may set.
std::vector<Setting> variants_settings();

/// Runs every way on every target with every seed. Ends early, with what was found so far, when `stop` is
/// set.
Race run_race(const Settings& settings, Progress& progress, const std::atomic<bool>& stop);

/// Writes result.json (further targets' in a folder of their name) and variants.csv.
void write_race(const Race& race, const std::filesystem::path& folder);

/// The report as a web page.
std::string race_page(const Race& race);

} // namespace app
