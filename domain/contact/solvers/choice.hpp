#pragma once

#include "domain/contact/solvers/problem.hpp"

#include <string>

namespace rough {

/// Up to this many nodes the factor always wins.
constexpr Index always_nested = 768;

/// The chosen solver, and why.
struct SolverChoice {
    Solver solver;      ///< the nested factor or the active set
    std::string reason; ///< in words, with the numbers that decided
};

/// The requested solver. `automatic` chooses between the nested factor and the active set by predicted memory
/// and cost. The model is fixed and uses no clock, so that the same problem is solved by the same method on
/// every machine. The size of the contact set is that of a grid of at most 2048 nodes, scaled.
SolverChoice choose_solver(const ContactProblem& problem, const ContactOptions& options);

/// Multiplications of the factor after which the active set would have been several times cheaper. Infinite
/// if the factor is always taken.
double max_nested_work(const ContactProblem& problem);

/// Throws InputError, before the nested solver begins, if its factor is predicted not to fit into memory.
void expect_factor_to_fit(const ContactProblem& problem, const ContactOptions& options);

} // namespace rough
