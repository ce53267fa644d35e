#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

// Each solver adds its load steps to `solution`, which keeps what was solved if it throws NotConverged. The
// certificate applies H by another path than the solver.

/// Direct: contact sets are nested (w > 0), so one bordered Cholesky factor grows through all load steps. The
/// set of nodes that penetrate under the pressures of the step before contains the new contact set, and
/// dropping the nodes under tension from it keeps it so; each step is therefore one sweep of additions and
/// some of removals. A load's approach follows from the factor. Throws InputError if the factor would take
/// more than the options' memory, NotConverged beyond their work.
void solve_nested(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Direct: non-negative least squares, min p'Hp/2 - p'(Delta - g0), p >= 0, by the active set of Lawson &
/// Hanson (1974, chapter 23) on a factor that is updated, never rebuilt, each load step starting from the one
/// before (Bemporad & Paggi 2015). The gradient is summed directly, so that the certificate can take the FFT.
/// At most 3 N iterations a step.
void solve_nnls(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Iterative: constrained conjugate gradients (Polonsky & Keer 1999, Wear 231, 206-219), H applied by FFT:
/// under load control as published; under displacement control neither gap nor pressure is shifted to meet a
/// load. Ends when every residual is within the tolerance and the contact set is beyond doubt at that
/// residual. At most 5,000 iterations a step: the method stalls on fine grids and near full contact.
void solve_polonsky_keer(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Iterative, for grids on which a dense factor does not fit: conjugate gradients by FFT on a contact set
/// that is corrected as they go, each load step predicted from the one before by its tangent vector. Ends
/// when every residual is within the tolerance and the contact set is beyond doubt at that residual, or
/// rounding allows no better.
void solve_active_set(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Contact with 0 <= p <= p_H: minimises p'Hp/2 - p'(Delta - g0) within the box by Bertsekas' projected
/// Newton method (1982). Each round solves H on the free nodes, those between the bounds or pulled away from
/// one, by preconditioned conjugate gradients, and projects a step towards that solution onto the box, halved
/// until the energy falls enough: it descends from any start and ends where no node is on the wrong bound.
/// Nothing is assumed of contact sets. Solved until gaps are 1e-11 of the approach.
void solve_capped(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Throws InputError if a factor of so many nodes would take more than the options' memory.
void refuse_factor(Index nodes, const ContactOptions& options);

/// What there is to know of a contact solver.
struct ContactSolver {
    const char* name;                                                        ///< as flags and files have it
    void (*solve)(const ContactProblem&, const ContactOptions&, Solution&);  ///< null: chooses one
    void (*capped)(const ContactProblem&, const ContactOptions&, Solution&); ///< null: knows no hardness
    bool direct;                                                             ///< by a factor, to rounding
    enum { never, on_maps, always } loads;                                   ///< in place of displacements
};

/// In the order of Solver.
inline constexpr ContactSolver contact_solvers[] = {
    {"auto", nullptr, solve_capped, false, ContactSolver::never},
    {"nested", solve_nested, nullptr, true, ContactSolver::always},
    {"nnls", solve_nnls, nullptr, true, ContactSolver::never},
    {"polonsky-keer", solve_polonsky_keer, nullptr, false, ContactSolver::always},
    {"active-set", solve_active_set, solve_capped, false, ContactSolver::on_maps},
};
/// The row of a solver.
inline const ContactSolver& row_of(Solver solver) {
    return contact_solvers[static_cast<std::size_t>(solver)];
}

} // namespace rough
