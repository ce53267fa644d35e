#pragma once

#include "apps/report/record.hpp"
#include "ga/run/context.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// So many candidates are kept of every generation; afterwards a stage's record stands in the place of its
/// last.
constexpr std::size_t most_candidates = 200000;

/// An observer that keeps every stage's candidates: identity, parents and similarity (the problem's first
/// objective; NaN where a stage left it unscored).
ga::Observer<rough::Genome> recorder(std::vector<StageRecord>& stages);

/// As a checkpoint keeps them.
void to_json(nlohmann::json& j, const StageRecord& stage);
void from_json(const nlohmann::json& j, StageRecord& stage);

/// The first record at the path, or nothing.
const StageRecord* stage_at(const std::vector<StageRecord>& stages, const std::string& path);

} // namespace app
