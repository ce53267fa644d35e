#pragma once

#include "apps/experiments/paper/run.hpp"

#include <filesystem>

namespace app {

/// Writes the run's tables beside its result.json: genomes.csv (the database), and for each target a folder
/// or the top one with scores.csv, stages.csv, thresholds.csv and curves.csv (the answers' responses).
void write_database_table(const PaperRun& run, const std::filesystem::path& folder);
void write_target_tables(const TargetRun& target, const std::filesystem::path& folder);

} // namespace app
