#include "domain/response/partial_slip.hpp"

#include "domain/errors.hpp"

#include <cmath>

namespace rough {

PartialSlip partial_slip(const Response& response, double friction) {
    if (!(friction > 0) || !std::isfinite(friction))
        refuse("friction coefficient ", friction, " is out of range (above 0, finite)");
    if (response.held_nodes > 0)
        refuse("partial slip: ", response.held_nodes,
               " nodes are at the hardness; use a profile in elastic contact");
    const Index n = response.steps();
    const auto backwards = [n](const Eigen::VectorXd& values) {
        Eigen::VectorXd rows(n + 1);
        rows << values.reverse(), 0;
        return rows;
    };
    const auto slipped = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
        return friction * (values[n - 1] - backwards(values).array());
    };
    return {slipped(response.displacement), slipped(response.pressure), backwards(response.tangent_stiffness),
            backwards(response.contact_fraction) / response.contact_fraction[n - 1]};
}

} // namespace rough
