#include "domain/contact/solvers/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rough {

double Certificate::residual() const { return std::max({gap, penetration, tension}); }

Certificate certify(const ContactProblem& problem, double approach, const std::vector<int>& contact,
                    const Eigen::VectorXd& pressure, const double* displacement) {
    const Eigen::Map<const Eigen::VectorXd> u(displacement, problem.nodes());
    const double scale = approach > 0 ? approach : 1, mean = pressure.sum() / problem.elements;
    constexpr double none = std::numeric_limits<double>::infinity();
    if (!std::isfinite(mean) || !std::isfinite(u.sum())) // a NaN anywhere is no solution at all
        return {none, none, none};
    double misfit = 0;
    for (const Index i : contact)
        misfit = std::max(misfit, std::abs(u[i] - (approach - problem.gap[i])));
    // Penetration is sought over all nodes: on the contact set it is part of |gap|.
    const double penetration = std::max(0.0, (approach - (problem.gap + u).array()).maxCoeff());
    const double tension = pressure.size() ? std::max(0.0, -pressure.minCoeff()) : 0;
    return {misfit / scale, penetration / scale, tension == 0 ? 0 : mean > 0 ? tension / mean : none};
}

double trusted_residual(const ContactProblem& problem, double approach, const Eigen::VectorXd& pressure,
                        const Eigen::VectorXd& displacement) {
    double margin = approach;
    for (Index i = 0; i < problem.nodes(); ++i)
        margin = std::min(margin, pressure[i] > 0 ? pressure[i] / 3
                                                  : (displacement[i] - (approach - problem.gap[i])) / 1.5);
    return margin / approach;
}

} // namespace rough
