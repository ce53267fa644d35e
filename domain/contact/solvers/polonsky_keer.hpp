#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// Constrained conjugate gradients (Polonsky & Keer 1999, Wear 231, 206-219), H applied by FFT: under load
/// control as published; under displacement control neither gap nor pressure is shifted to meet a load. Ends
/// when every residual is within the tolerance and the contact set is beyond doubt at that residual. Steps
/// are added to `solution`, which keeps what was solved if this throws. Throws NotConverged after 5,000
/// iterations of a step: the method stalls on fine grids and near full contact.
void solve_polonsky_keer(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

} // namespace rough
