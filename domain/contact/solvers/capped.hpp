#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// Contact with 0 <= p <= p_H: minimises p'Hp/2 - p'(Delta - g0) within the box by Bertsekas' projected
/// Newton method (1982). Each round solves H on the free nodes, those between the bounds or pulled away from
/// one, by preconditioned conjugate gradients, and projects a step towards that solution onto the box, halved
/// until the energy falls enough: it descends from any start and ends where no node is on the wrong bound.
/// Nothing is assumed of contact sets. Solved until gaps are 1e-11 of the approach; the certificate applies H
/// by another path. Throws NotConverged.
Solution solve_capped(const ContactProblem& problem, const ContactOptions& options);

} // namespace rough
