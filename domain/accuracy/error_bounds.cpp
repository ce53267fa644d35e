#include "domain/accuracy/error_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

Eigen::VectorXd differences(const Eigen::VectorXd& pressure) {
    const Eigen::Index n = pressure.size();
    Eigen::VectorXd result = pressure;
    result.tail(n - 1) -= pressure.head(n - 1);
    return result;
}

ErrorScale error_scale(const Eigen::VectorXd& pressure, double light) {
    const double floor = light * pressure[pressure.size() - 1];
    ErrorScale scale{pressure.cwiseMax(floor), differences(pressure)};
    for (Eigen::Index j = 0; j < pressure.size(); ++j)
        if (pressure[j] < floor)
            scale.difference[j] = std::max(scale.difference[j], floor);
    return scale;
}

Eigen::Index light_rows(const Eigen::VectorXd& pressure) {
    return (pressure.array() < light_load * pressure[pressure.size() - 1]).count();
}

Doubt Doubt::known_up_to(Eigen::Index rows, double offset) const {
    const Eigen::Index rest = pressure.size() - rows;
    Doubt result = *this;
    result.pressure.head(rows).setZero();
    result.difference.head(rows).setZero();
    result.pressure.tail(rest).array() += std::abs(offset);
    return result;
}

Doubt operator+(const Doubt& a, const Doubt& b) {
    return {a.pressure + b.pressure, a.difference + b.difference};
}

Doubt doubt_of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    const Eigen::VectorXd below = pressure - lower, above = upper - pressure;
    Doubt doubt{below.cwiseMax(above), below.cwiseMax(above)};
    for (Eigen::Index j = 1; j < pressure.size(); ++j)
        doubt.difference[j] = std::max(above[j] + below[j - 1], below[j] + above[j - 1]);
    return doubt;
}

Eigen::VectorXd relative(const Doubt& doubt, const ErrorScale& scale) {
    const Eigen::VectorXd pressure = doubt.pressure.cwiseQuotient(scale.pressure);
    const double last = pressure[pressure.size() - 1]; // a light load's scale is a part of the last pressure
    Eigen::VectorXd error = pressure.cwiseMax(doubt.difference.cwiseQuotient(scale.difference));
    for (double& each : error)
        each = std::max(each, last) < 1 ? each / (1 - std::max(each, last)) : HUGE_VAL;
    return error;
}

Eigen::Index rows_to_know(const Doubt& doubt, const ErrorScale& scale, double accuracy) {
    Eigen::Index known = scale.pressure.size();
    double worst = 0;
    accuracy /= 1 + accuracy; // of the curve's pressures, as in relative()
    for (Eigen::Index j = known - 1; j >= 0; --j) {
        worst = std::max(worst, doubt.pressure[j] / scale.pressure[j]);
        if (!(std::max(worst, doubt.difference[j] / scale.difference[j]) <= accuracy))
            break;
        if (j == 0 || worst + doubt.pressure[j - 1] / scale.pressure[j] <= accuracy)
            known = j;
    }
    return known;
}

double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved) {
    const ErrorScale scale = error_scale(resolved);
    const Eigen::VectorXd error = pressure - resolved;
    return std::max(error.cwiseAbs().cwiseQuotient(scale.pressure).maxCoeff(),
                    differences(error).cwiseAbs().cwiseQuotient(scale.difference).maxCoeff());
}

} // namespace rough
