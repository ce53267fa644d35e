#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The residual below which rounding makes further iterations pointless.
inline constexpr double finest_residual = 1e-12;
/// Gaps and penetrations below this, over the approach, are rounding.
inline constexpr double gap_rounding = 1e-13;

// Each solver adds its load steps to `solution`. The solved ones stay there if it throws NotConverged. The
// certificate applies H by another method than the solver.

/// Direct: contact sets are nested (w > 0), so one bordered Cholesky factor grows through all load steps. Each step is
/// one sweep of additions and some of removals. A load's approach follows from the factor. Throws InputError if the
/// factor would take more than the options' memory, NotConverged beyond the work limit.
void solve_nested(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Direct: non-negative least squares, min p'Hp/2 - p'(Delta - g0), p >= 0, by the active set of Lawson & Hanson (1974,
/// chapter 23). Its factor is updated, never rebuilt, and each load step starts from the one before (Bemporad & Paggi
/// 2015). The gradient is summed directly, so that the certificate can use the FFT. At most 3 N iterations per step.
void solve_nnls(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Iterative: constrained conjugate gradients (Polonsky & Keer 1999, Wear 231, 206-219), H applied by FFT.
/// Load control is as published. In displacement control neither gap nor pressure is shifted to reach the
/// required load. Ends if every residual is within the tolerance and the contact set is certain at that
/// residual. At most 5,000 iterations per step: the method stalls on fine grids and near full contact.
void solve_polonsky_keer(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Iterative, for grids on which a dense factor does not fit: conjugate gradients by FFT on a contact set
/// that is corrected during the iteration. Each load step starts from the one before, moved along its
/// tangent. Ends if every residual is within the tolerance and the contact set is certain at that residual,
/// or if rounding allows no better. If the set does not converge at an approach, solve_capped() continues.
void solve_active_set(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Contact with 0 <= p <= p_H, which may be infinite. Bertsekas' projected Newton method (1982) minimises p'Hp/2 -
/// p'(Delta - g0) within the box. Each round solves H on the free nodes, which are between the bounds or pulled away
/// from one, by preconditioned conjugate gradients. It projects a step towards that solution onto the box and halves it
/// until the energy falls enough. It descends from any start and ends if no node is on the wrong bound. It assumes
/// nothing about contact sets. Solved until gaps are 1e-11 of the approach.
void solve_capped(const ContactProblem& problem, const ContactOptions& options, Solution& solution);

/// Partial slip by the same method: tractions |q| <= `limit` (N entries) minimise q'Tq/2 - q'd at each
/// tangential displacement d. T is the problem's matrix, and its approaches are d. The nodes of a step are
/// those with a limit above 0, and those held slip.
void solve_slip(const ContactProblem& problem, const Eigen::VectorXd& limit, const ContactOptions& options,
                Solution& solution);

/// Throws InputError if a factor of `nodes` nodes would take more than the options' memory.
void refuse_factor(Index nodes, const ContactOptions& options);

/// Properties of a contact solver.
struct ContactSolver {
    const char* name;                                                       ///< as flags and files have it
    void (*solve)(const ContactProblem&, const ContactOptions&, Solution&); ///< null: chooses a solver
    bool capped;                                                            ///< can hold a hardness, by solve_capped()
    bool direct;                                                            ///< solves by a factor, to rounding
    enum { never, on_maps, always } loads; ///< when it takes loads instead of displacements
};

/// In the order of Solver.
inline constexpr ContactSolver contact_solvers[] = {
    {"auto", nullptr, true, false, ContactSolver::never},
    {"nested", solve_nested, false, true, ContactSolver::always},
    {"nnls", solve_nnls, false, true, ContactSolver::never},
    {"polonsky-keer", solve_polonsky_keer, false, false, ContactSolver::always},
    {"active-set", solve_active_set, true, false, ContactSolver::on_maps},
};
/// The row of a solver.
inline const ContactSolver& row_of(Solver solver) { return contact_solvers[static_cast<std::size_t>(solver)]; }

/// Up to this many nodes the factor always wins.
constexpr Index always_nested = 768;

/// The requested solver; for `automatic` the nested factor or the active set, by the fixed model of memory
/// and cost of README.md.
Solver choose_solver(const ContactProblem& problem, const ContactOptions& options);

/// Multiplications of the factor after which the active set would have been several times cheaper. Infinite
/// if the factor is always taken.
double max_nested_work(const ContactProblem& problem);

/// Throws InputError, before the nested solver begins, if its factor is predicted not to fit into memory.
void expect_factor_to_fit(const ContactProblem& problem, const ContactOptions& options);

} // namespace rough
