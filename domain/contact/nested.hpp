#pragma once

#include "domain/contact/problem.hpp"

namespace rough {

/// The direct solver: contact sets are nested (w > 0), so one bordered Cholesky factor grows through all load
/// steps. The set of nodes that penetrate under the pressures of the step before contains the new contact
/// set, and dropping the nodes under tension from it keeps it so; each step is therefore one sweep of
/// additions and some of removals. Throws InputError where the factor would take more than `memory_limit`
/// bytes, NotConverged where it does not settle.
Solution solve_nested(const ContactProblem& problem, const ContactOptions& options);

/// Throws InputError where a factor of so many nodes would take more than the options' memory.
void refuse_factor(Index nodes, const ContactOptions& options);

} // namespace rough
