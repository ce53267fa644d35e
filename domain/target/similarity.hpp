#pragma once

#include "domain/response/sensitivity.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// An interval of pressure, MPa, ends included.
struct Interval {
    double from; ///< MPa
    double to;   ///< MPa, no less than `from`
};

/// Which of the target's points lie in the interval.
std::vector<Index> points_within(const Target& target, const Interval& interval);

/// y(xi_k)/y_k - 1 at the given points of the target.
Eigen::VectorXd relative_misfit(const Target& target, const Curve& curve, const std::vector<Index>& points);

/// Similarity, Eq. 12: s = 1 - max_k |y_k - y(xi_k)|/|y_k| over the points given. 1 is equal; may be
/// negative. Throws InputError on no points, or a point outside the curve's range.
double similarity(const Target& target, const Curve& curve, const std::vector<Index>& points);
/// Over all of the target's points.
double similarity(const Target& target, const Curve& curve);

/// How far one response meets another (the second taken as target at its own secant abscissas, both stretched
/// to the same highest pressure): used to judge a reduced profile against the whole.
double similarity(const Curve& reference, const Curve& curve);

/// d relative_misfit/dgene at the given points of the target, points x genes.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const std::vector<Index>& points);

} // namespace rough
