#include "domain/economy/accuracy.hpp"

#include <algorithm>

namespace rough {

Eigen::VectorXd differences(const Eigen::VectorXd& pressure) {
    const Eigen::Index n = pressure.size();
    Eigen::VectorXd result = pressure;
    result.tail(n - 1) -= pressure.head(n - 1);
    return result;
}

ErrorScale error_scale(const Eigen::VectorXd& pressure) {
    const double floor = light_load * pressure[pressure.size() - 1];
    ErrorScale scale{pressure.cwiseMax(floor), differences(pressure)};
    for (Eigen::Index j = 0; j < pressure.size(); ++j)
        if (pressure[j] < floor)
            scale.difference[j] = std::max(scale.difference[j], floor);
    return scale;
}

double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved) {
    const ErrorScale scale = error_scale(resolved);
    const Eigen::VectorXd error = pressure - resolved;
    return std::max(error.cwiseAbs().cwiseQuotient(scale.pressure).maxCoeff(),
                    differences(error).cwiseAbs().cwiseQuotient(scale.difference).maxCoeff());
}

} // namespace rough
