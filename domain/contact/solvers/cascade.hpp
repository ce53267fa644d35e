#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The same problem on every `stride`-th node from `first` (< stride) on.
ContactProblem coarsened(const ContactProblem& problem, Index stride, Index first = 0);

/// Pressures at every node of the fine grid guessed from a coarse grid's solution: linear in p^2, which near
/// an edge falls linearly to zero, so that edges are found within the coarse spacing.
Eigen::VectorXd refined_pressures(const StepSolution& coarse, Index coarse_nodes, Index stride, Index nodes);

} // namespace rough
