#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The same problem on every `stride`-th node, along x and y, with `node` among them.
ContactProblem coarsened(const ContactProblem& problem, Index stride, Index node = 0);

/// Pressures at every node of the fine grid guessed from the solution on every `stride`-th one from the first
/// on: linear in p^2 along x, then along y, which near an edge falls linearly to zero, so that edges are
/// found within the coarse spacing.
Eigen::VectorXd refined_pressures(const StepSolution& coarse, Extent coarse_shape, Index stride,
                                  Extent shape);

} // namespace rough
