#include "domain/target/similarity.hpp"

namespace rough {

Eigen::VectorXd misfit(const Target& target, const Curve& curve) {
    Eigen::VectorXd misfits(target.points());
    for (Index k = 0; k < target.points(); ++k)
        misfits[k] = misfit(target, k, curve.at(target.x[k]));
    return misfits;
}

Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const Eigen::VectorXd& misfits) {
    Eigen::MatrixXd result(target.points(), jacobian.x.cols());
    for (Index k = 0; k < target.points(); ++k) {
        if (target.has_band() && misfits[k] == 0) {
            result.row(k).setZero();
            continue;
        }
        const auto [left, weight] = segment_at(curve, target.x[k]);
        const double slope = (curve.y[left + 1] - curve.y[left]) / (curve.x[left + 1] - curve.x[left]);
        // y(x) = y_l + slope (x - x_l): moving the points' abscissas moves the line under x.
        result.row(k) = ((1 - weight) * (jacobian.y.row(left) - slope * jacobian.x.row(left)) +
                         weight * (jacobian.y.row(left + 1) - slope * jacobian.x.row(left + 1))) /
                        target.y[k];
    }
    return target.weight * result;
}

double similarity(const Target& target, const Curve& curve) { return similarity(misfit(target, curve)); }

double similarity(const Curve& reference, const Curve& curve) {
    Target whole;
    whole.name = "reference";
    whole.x = reference.x;
    whole.y = reference.y;
    return similarity(whole, stretched(curve, reference.to / curve.to)); // Eq. 11
}

} // namespace rough
