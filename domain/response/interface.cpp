#include "domain/response/interface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rough {

namespace {

/// Rounding error of 1 - K/K_full.
constexpr double rounding = 1e-12;

/// K/K_i = 1 - K/K_full, or 0 if it is only rounding.
double interface_share(double stiffness, double full_stiffness) {
    if (std::isnan(full_stiffness))
        throw std::logic_error("interface stiffness of a response without its full contact's stiffness");
    const double share = 1 - stiffness / full_stiffness;
    return share > rounding ? share : 0;
}

} // namespace

Eigen::VectorXd interface_stiffness(const Response& response) {
    Eigen::VectorXd result(response.steps());
    for (Index j = 0; j < response.steps(); ++j) {
        const double K = response.tangent_stiffness[j], share = interface_share(K, response.full_stiffness);
        const bool full = response.contact_fraction[j] == 1 && response.held_nodes == 0;
        result[j] = K == 0 ? 0 : full || share == 0 ? std::numeric_limits<double>::infinity() : K / share;
    }
    return result;
}

double interface_of(double stiffness, double full_stiffness) {
    return stiffness / std::max(interface_share(stiffness, full_stiffness), rounding);
}

CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness) {
    for (Index j = 0; j < stiffness.y.size(); ++j) {
        // dK_i = (K_i/K)^2 dK, as d(1/K_i) = d(1/K)
        const double share = interface_share(stiffness.y[j], full_stiffness);
        jacobian.y.row(j) *= share > 0 ? 1 / (share * share) : 0;
    }
    return jacobian;
}

Curve interface_secants(const Response& response) {
    Curve curve = secant_stiffness(response);
    for (double& K : curve.y)
        K = interface_of(K, response.full_stiffness);
    return curve;
}

} // namespace rough
