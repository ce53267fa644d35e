#pragma once

#include "domain/contact/solvers/problem.hpp"

#include <string>

namespace rough {

/// Up to this many nodes the factor always wins.
constexpr Index always_nested = 768;

/// What `automatic` takes, and why in words.
struct SolverChoice {
    Solver solver;      ///< the nested factor or the active set
    std::string reason; ///< with the figures that decided
};

/// Between the nested factor and the active set, by predicted memory and cost. The model is fixed and knows
/// no clock, so that the same problem is solved by the same method everywhere; the contact set's size is that
/// of a grid of at most 2048 nodes, scaled.
SolverChoice choose_solver(const ContactProblem& problem, const ContactOptions& options);

/// Multiplications of the factor beyond which the choice of the nested solver was wrong by far: the active
/// set would have been several times cheaper. Infinite where the factor is always taken.
double most_nested_work(const ContactProblem& problem);

/// Refuses the nested solver before it begins where its factor is predicted not to fit. Throws InputError.
void expect_factor_to_fit(const ContactProblem& problem, const ContactOptions& options);

} // namespace rough
