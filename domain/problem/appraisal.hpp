#pragma once

#include "domain/problem/problem.hpp"

namespace rough {

/// An evaluation that goes from one load step to the next and tells after each how similar the curve can
/// still be (SimilarityBound). Null where the set-up or the genome allows none: without Eq. 11, within an
/// accuracy, on other solvers than the nested factor, on areas and grids too fine for it, for a flat profile.
std::unique_ptr<ga::Appraisal<DesignOutcome>> step_by_step(const DesignProblem& problem,
                                                           const Genome& genome);

} // namespace rough
