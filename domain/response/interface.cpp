#include "domain/response/interface.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace rough {

namespace {

/// Of 1/K: what 1/K - 1/K_full may be off by rounding.
constexpr double rounding = 1e-12;

double compliance(double stiffness, double full_stiffness) {
    if (std::isnan(full_stiffness))
        throw std::logic_error("interface stiffness of a response without its full contact's stiffness");
    return 1 / stiffness - 1 / full_stiffness;
}

bool is_rounding(double stiffness, double full_stiffness) {
    return !(compliance(stiffness, full_stiffness) > rounding / stiffness);
}

} // namespace

Eigen::VectorXd interface_stiffness(const Response& response) {
    Eigen::VectorXd result(response.steps());
    for (Index j = 0; j < response.steps(); ++j) {
        const double K = response.tangent_stiffness[j], full = response.full_stiffness;
        result[j] = response.contact_fraction[j] == 1 || is_rounding(K, full)
                        ? std::numeric_limits<double>::infinity()
                        : 1 / compliance(K, full);
    }
    return result;
}

Curve interface_curve(Curve stiffness, double full_stiffness) {
    for (double& K : stiffness.y)
        K = is_rounding(K, full_stiffness) ? K / rounding : 1 / compliance(K, full_stiffness);
    return stiffness;
}

CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness) {
    for (Index j = 0; j < stiffness.y.size(); ++j) {
        const double K = stiffness.y[j];
        // dK_i = (K_i/K)^2 dK, as d(1/K_i) = d(1/K)
        jacobian.y.row(j) *=
            is_rounding(K, full_stiffness) ? 0 : std::pow(1 / (K * compliance(K, full_stiffness)), 2);
    }
    return jacobian;
}

Curve interface_secants(const Response& response) {
    return interface_curve(secant_stiffness(response), response.full_stiffness);
}

} // namespace rough
