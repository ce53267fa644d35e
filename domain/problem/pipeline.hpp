#pragma once

#include "domain/problem/problem.hpp"
#include "ga/text/compiled_once.hpp"

namespace rough {

/// A pipeline on a design's problem, e.g. the paper's.
using Pipeline = ga::Stage<DesignProblem>;

/// The engine's operators for text pipelines on this problem.
ga::Registry<DesignProblem> engine_words();

} // namespace rough

/// @cond
GA_PIPELINES_ELSEWHERE(rough::DesignProblem)
/// @endcond
