#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The scale-free residual of the contact conditions at one load step: the largest of |gap| on the contact
/// set and penetration off it (over the approach), tension and pressure over the cap (over the mean
/// pressure). Nodes at the cap may penetrate; a gap there counts as on the contact set.
struct Certificate {
    double gap = 0;         ///< largest |u - (Delta - g0)|/Delta on the contact set
    double penetration = 0; ///< largest (Delta - g0 - u)/Delta off it
    double tension = 0;     ///< largest -p/P
    double excess = 0;      ///< largest (p - p_H)/P
    /// The largest of them.
    double residual() const { return std::max({gap, penetration, tension, excess}); }
};

/// Largest residual of a factor's solution, over the approach: 1e-9, or the bound of rounding if that is larger, as it
/// is near full contact. Cholesky's |H x - b| <= (3 m + 1) 2^-53 |L||L'||x| (Higham 2002, theorem 10.4), and |L||L'| <=
/// h_0 entry by entry. p = L^-T (Delta z - v) with z'z = sum H_AA^-1 1 = `stiffness`, which diverges as the last nodes
/// touch. The two terms then nearly cancel, and each brings sqrt(h_0) |z| Delta.
double direct_tolerance(const ContactProblem& problem, const StepSolution& step);

/// `displacement` is u = H p at every node, by a method different from the one that found p.
Certificate certify(const ContactProblem& problem, double approach, const std::vector<int>& contact,
                    const Eigen::VectorXd& pressure, const double* displacement);

/// Throws NotConverged if a step's residual exceeds the tolerance.
void expect_residual(const char* solver, const ContactProblem& problem, const StepSolution& step, double tolerance);
/// Sets a step's residual, with H applied to the pressures at every node by `check`; then the same check.
void certify_step(const char* solver, const ContactProblem& problem, StepSolution& step, SplitOperator& check,
                  const Eigen::VectorXd& pressure, double tolerance);

/// The residual, over the approach, up to which no node can touch or leave unnoticed. If displacements on the
/// contact set err by e, those off it err by at most e, and the pressures by a few times e. `pressure` and
/// `displacement` are given at every node; a node with pressure is in contact. At most 1.
double trusted_residual(const ContactProblem& problem, double approach, const Eigen::VectorXd& pressure,
                        const Eigen::VectorXd& displacement);

} // namespace rough
