#pragma once

#include "apps/experiments/accuracy/run.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/settings.hpp"

#include <atomic>
#include <filesystem>

namespace app {

/// The keys that experiments/accuracy.ini may set.
std::vector<Setting> accuracy_study_settings();

/// Charts cost against accuracy, searches with and without fidelity, and makes a designed surface's error
/// budget. Ends early, with what was found so far, when `stop` is set.
AccuracyRun run_accuracy_study(const Settings& settings, Progress& progress, const std::atomic<bool>& stop);

/// Writes result.json, savings.csv, searches.csv and budget.csv.
void write_accuracy_study(const AccuracyRun& run, const std::filesystem::path& folder);

/// The report as a web page.
std::string accuracy_page(const AccuracyRun& run);

} // namespace app
