#include "domain/contact/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rough {

double Certificate::residual() const {
    const double largest = std::max({gap, penetration, tension});
    // A NaN anywhere is no solution at all.
    return std::isnan(gap + penetration + tension) ? std::numeric_limits<double>::infinity() : largest;
}

Certificate certify(const ContactProblem& problem, double approach, const std::vector<int>& contact,
                    const Eigen::VectorXd& pressure, const double* displacement) {
    Certificate certificate;
    const Index n = problem.nodes();
    double misfit = 0, penetration = 0, tension = 0, sum = 0;
    // Penetration is sought over all nodes: on the contact set it is part of |gap|.
    for (Index i = 0; i < n; ++i)
        penetration = std::max(penetration, approach - problem.gap[i] - displacement[i]);
    for (std::size_t k = 0; k < contact.size(); ++k) {
        const Index i = contact[k];
        misfit = std::max(misfit, std::abs(displacement[i] - (approach - problem.gap[i])));
        tension = std::max(tension, -pressure[static_cast<Index>(k)]);
        sum += pressure[static_cast<Index>(k)];
    }
    const double scale = approach > 0 ? approach : 1;
    const double mean = sum / problem.elements;
    certificate.gap = misfit / scale;
    certificate.penetration = penetration / scale;
    certificate.tension = tension == 0 ? 0
                          : mean > 0   ? tension / mean
                                       : std::numeric_limits<double>::infinity();
    return certificate;
}

} // namespace rough
