#include "domain/accuracy/extrapolation.hpp"

#include <cmath>

namespace rough {

namespace {

constexpr double pressure_order = 1.5;          ///< between the erratic part's order and 2
constexpr double weight_order = 3;              ///< the scatter's variance falls as N^-3
constexpr double safety = 2.3, thin_safety = 3; ///< thin: three grids, one more than a line needs

/// A weighted straight line in x = N^-order - resolved^-order, read at x = 0.
struct Line {
    Eigen::VectorXd x, weights, reading; ///< value at x = 0 is values * reading
    double variance = 0;                 ///< of that value, for scatter of unit weight

    Line(const std::vector<Index>& grids, Index resolved, double order)
        : x(static_cast<Index>(grids.size())), weights(x.size()) {
        for (Index i = 0; i < x.size(); ++i) {
            const auto n = static_cast<double>(grids[static_cast<std::size_t>(i)]);
            x[i] = std::pow(n, -order) - std::pow(static_cast<double>(resolved), -order);
            weights[i] = std::pow(n / static_cast<double>(grids.back()), weight_order);
        }
        const double s0 = weights.sum(), s1 = weights.dot(x), s2 = weights.dot(x.cwiseAbs2());
        const double determinant = s0 * s2 - s1 * s1;
        reading = weights.cwiseProduct(Eigen::VectorXd::Constant(x.size(), s2) - s1 * x) / determinant;
        variance = s2 / determinant;
    }

    Eigen::VectorXd read(const Eigen::MatrixXd& values) const { return values * reading; }

    /// Standard error of each row's reading.
    Eigen::VectorXd standard_error(const Eigen::MatrixXd& values) const {
        const Eigen::VectorXd at_zero = read(values);
        const Eigen::VectorXd slope =
            (values.colwise() - at_zero) * weights.cwiseProduct(x) / weights.dot(x.cwiseAbs2());
        const Eigen::MatrixXd rest = (values.colwise() - at_zero) - slope * x.transpose();
        const double freedom = static_cast<double>(x.size() - 2);
        return (rest.cwiseAbs2() * weights * (variance / freedom)).cwiseSqrt();
    }
};

} // namespace

Eigen::VectorXd extrapolated(const std::vector<Index>& grids, const Eigen::MatrixXd& values, Index resolved,
                             double order) {
    return Line(grids, resolved, order).read(values);
}

Extrapolation extrapolate(const std::vector<Index>& grids, const Eigen::MatrixXd& pressures, Index resolved) {
    const Line line(grids, resolved, pressure_order);
    Eigen::MatrixXd steps = pressures;
    steps.bottomRows(steps.rows() - 1) -= pressures.topRows(steps.rows() - 1);
    const double factor = grids.size() > 3 ? safety : thin_safety;
    const auto doubt = [&](const Eigen::MatrixXd& values) -> Eigen::VectorXd {
        const Eigen::VectorXd distance = (line.read(values) - values.rightCols(1)).cwiseAbs();
        return factor * distance.cwiseMax(line.standard_error(values));
    };
    return {line.read(pressures).cwiseMax(0), {doubt(pressures), doubt(steps)}};
}

} // namespace rough
