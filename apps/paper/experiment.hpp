#pragma once

#include "apps/paper/run.hpp"
#include "apps/progress.hpp"
#include "apps/settings.hpp"

#include <atomic>

namespace app {

/// The keys that experiments/paper.ini may set.
std::vector<Setting> paper_settings();

/// Where a run keeps what it has done so far.
struct Keeping {
    std::filesystem::path folder; ///< checkpoints/ and log/ go below it, one file a target and variant
    bool resume = false;          ///< go on from the checkpoints that are there
};

/// Runs the paper's experiment: the database, the variants on every target, the threshold sweep. Relative
/// paths in the file are looked for beside it.
PaperRun run_paper(const Settings& settings, Progress& progress, const std::atomic<bool>& stop,
                   const Keeping& keeping);

} // namespace app
