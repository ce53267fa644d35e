#pragma once

#include "apps/experiments/paper/run.hpp"

namespace app {

/// The report of the paper's experiment: one self-contained HTML page with Figures 1 to 11, the table of
/// claims with their verdicts, and what rests on our reading of the paper.
std::string paper_page(const PaperRun& run);

} // namespace app
