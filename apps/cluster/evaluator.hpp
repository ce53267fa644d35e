#pragma once

#include "domain/problem/problem.hpp"
#include "ga/run/evaluator.hpp"

namespace app {

/// Who makes the paid calls of designs on so many threads, 0 for all: this rank alone, or all of them. The
/// bits are the same.
std::unique_ptr<ga::Evaluator<rough::DesignProblem>> design_evaluator(int threads);

} // namespace app
