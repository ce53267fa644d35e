#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// Constrained conjugate gradients (Polonsky & Keer 1999, Wear 231, 206-219), H applied by FFT, under
/// displacement control: their iteration with the approach given, so that neither gap nor pressure is shifted
/// to meet a load. Ends when every residual is within the tolerance and the contact set is beyond doubt at
/// that residual. Throws NotConverged after 5,000 iterations of a step: the method stalls on fine grids and
/// near full contact.
Solution solve_polonsky_keer(const ContactProblem& problem, const ContactOptions& options);

/// The same under load control, as published: `loads` are sums of the nodes' pressures in the problem's
/// units, positive and increasing. Sets the problem's approaches to those found.
Solution solve_polonsky_keer_loads(ContactProblem& problem, const std::vector<double>& loads,
                                   const ContactOptions& options);

} // namespace rough
