#pragma once

#include "apps/experiments/paper/run.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/settings.hpp"

#include <atomic>

namespace app {

/// Where a run keeps what it has done so far.
struct Keeping {
    std::filesystem::path folder; ///< checkpoints/ and log/ go below it, one file a target and variant
    bool resume = false;          ///< go on from the checkpoints that are there
};

/// Runs the paper's experiment: the database, the variants on every target, the threshold sweep. `settings`
/// are those of paper_settings().
PaperRun run_paper(const Settings& settings, Progress& progress, const std::atomic<bool>& stop,
                   const Keeping& keeping);

} // namespace app
