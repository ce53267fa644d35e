#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The scale-free residual of the contact conditions at one load step: the largest of |gap| on the contact
/// set and penetration off it (over the approach), and tension (over the mean pressure).
struct Certificate {
    double gap = 0;          ///< largest |u - (Delta - g0)|/Delta on the contact set
    double penetration = 0;  ///< largest (Delta - g0 - u)/Delta off it
    double tension = 0;      ///< largest -p/P
    double residual() const; ///< the largest of the three
};

/// `displacement` is u = H p at every node, by another path than the one that found p.
Certificate certify(const ContactProblem& problem, double approach, const std::vector<int>& contact,
                    const Eigen::VectorXd& pressure, const double* displacement);

/// The residual, over the approach, at which no node could touch or leave unseen: with an error e of the
/// displacement on the contact set, that off it errs by no more than e and the pressures by a few times e.
/// `pressure` and `displacement` at every node; a node with pressure is in contact. At most 1.
double trusted_residual(const ContactProblem& problem, double approach, const Eigen::VectorXd& pressure,
                        const Eigen::VectorXd& displacement);

} // namespace rough
