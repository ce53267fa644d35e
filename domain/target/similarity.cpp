#include "domain/target/similarity.hpp"

#include "domain/errors.hpp"

#include <numeric>

namespace rough {

std::vector<Index> points_within(const Target& target, const Interval& interval) {
    std::vector<Index> points;
    for (Index k = 0; k < target.points(); ++k)
        if (target.pressure[k] >= interval.from && target.pressure[k] <= interval.to)
            points.push_back(k);
    return points;
}

Eigen::VectorXd relative_misfit(const Target& target, const Curve& curve, const std::vector<Index>& points) {
    Eigen::VectorXd misfit(static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        misfit[static_cast<Index>(i)] =
            curve.at(target.pressure[points[i]]) / target.stiffness[points[i]] - 1;
    return misfit;
}

double similarity(const Target& target, const Curve& curve, const std::vector<Index>& points) {
    if (points.empty())
        throw InputError("target " + target.name + ": no point in the interval, expected at least one");
    return 1 - relative_misfit(target, curve, points).cwiseAbs().maxCoeff(); // Eq. 12
}

double similarity(const Target& target, const Curve& curve) {
    std::vector<Index> all(static_cast<std::size_t>(target.points()));
    std::iota(all.begin(), all.end(), Index{0});
    return similarity(target, curve, all);
}

double similarity(const Curve& reference, const Curve& curve) {
    const Curve same_load = stretched(curve, reference.to / curve.to);
    return similarity({"reference", reference.x, reference.y}, same_load);
}

Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const std::vector<Index>& points) {
    Eigen::MatrixXd result(static_cast<Index>(points.size()), jacobian.x.cols());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double xi = target.pressure[points[i]];
        const auto [left, weight] = segment_at(curve, xi);
        const double slope = (curve.y[left + 1] - curve.y[left]) / (curve.x[left + 1] - curve.x[left]);
        // y(xi) = y_l + slope (xi - x_l): moving the points' abscissas moves the line under xi.
        result.row(static_cast<Index>(i)) =
            ((1 - weight) * (jacobian.y.row(left) - slope * jacobian.x.row(left)) +
             weight * (jacobian.y.row(left + 1) - slope * jacobian.x.row(left + 1))) /
            target.stiffness[points[i]];
    }
    return result;
}

} // namespace rough
