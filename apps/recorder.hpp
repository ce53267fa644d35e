#pragma once

#include "apps/report/paper_data.hpp"
#include "ga/context.hpp"

namespace app {

/// An observer that keeps every stage's candidates: identity, parents and similarity (the problem's first
/// objective; NaN where a stage left it unscored).
ga::Observer<rough::Genome> recorder(std::vector<StageRecord>& stages);

/// The first record at the path, or nothing.
const StageRecord* stage_at(const std::vector<StageRecord>& stages, const std::string& path);

} // namespace app
