#pragma once

#include "apps/experiments/paper/run.hpp"

#include <filesystem>

namespace app {

/// Writes the run: genomes.csv (the database) and, for the first target to the folder and for the second to
/// `heldout` in it, result.json, scores.csv, stages.csv, thresholds.csv and curves.csv (the answers'
/// responses).
void write_paper(const PaperRun& run, const std::filesystem::path& folder);

} // namespace app
