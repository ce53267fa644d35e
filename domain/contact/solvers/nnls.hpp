#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// Non-negative least squares: min p'Hp/2 - p'(Delta - g0), p >= 0, by the active set of Lawson & Hanson
/// (1974, chapter 23) on a factor that is updated, never rebuilt, each load step starting from the one before
/// (Bemporad & Paggi 2015). The gradient is summed directly, so that the certificate can take the FFT. Under
/// displacement control only. Steps are added to `solution`, which keeps what was solved if this throws.
/// Throws NotConverged if a step takes more than 3 N iterations.
void solve_nnls(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

} // namespace rough
