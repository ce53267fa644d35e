#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The iterative solver for grids on which a dense factor does not fit: conjugate gradients by FFT on a
/// contact set that is corrected as they go, each load step predicted from the one before by its tangent
/// vector. Ends when every residual is within the tolerance and the contact set is beyond doubt at that
/// residual, or rounding allows no better. Load control is for maps only. Throws NotConverged. The
/// certificate applies H by another splitting into transforms. Steps are added to `solution`, which keeps
/// what was solved if this throws.
void solve_active_set(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

} // namespace rough
