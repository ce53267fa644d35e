#include "domain/response/sensitivity.hpp"

namespace rough {

CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian) {
    const Index steps = response.steps(), genes = jacobian.pressure.cols();
    CurveJacobian result{Eigen::MatrixXd(steps, genes), Eigen::MatrixXd(steps, genes)};
    Eigen::RowVectorXd last = Eigen::RowVectorXd::Zero(genes);
    double last_pressure = 0, last_displacement = 0;
    for (Index j = 0; j < steps; ++j) {
        const double step = response.displacement[j] - last_displacement;
        const double K = (response.pressure[j] - last_pressure) / step;
        result.x.row(j) = 0.5 * (jacobian.pressure.row(j) + last);
        // All steps are equal parts of the last displacement: dK = (dP_j - dP_{j-1} - K d step)/step.
        result.y.row(j) =
            (jacobian.pressure.row(j) - last - K / static_cast<double>(steps) * jacobian.last_displacement) /
            step;
        last = jacobian.pressure.row(j);
        last_pressure = response.pressure[j];
        last_displacement = response.displacement[j];
    }
    return result;
}

} // namespace rough
