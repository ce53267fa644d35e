#pragma once

#include "apps/economy/run.hpp"
#include "apps/progress.hpp"
#include "apps/settings.hpp"

#include <atomic>
#include <filesystem>

namespace app {

/// The keys that experiments/economy.ini may set.
std::vector<Setting> economy_settings();

/// Charts cost against accuracy, searches with and without fidelity, and makes a designed surface's error
/// budget. Ends early, with what was found so far, when `stop` is set.
EconomyRun run_economy(const Settings& settings, Progress& progress, const std::atomic<bool>& stop);

/// Writes result.json, savings.csv, searches.csv and budget.csv.
void write_economy(const EconomyRun& run, const std::filesystem::path& folder);

/// The report as a web page.
std::string economy_page(const EconomyRun& run);

} // namespace app
