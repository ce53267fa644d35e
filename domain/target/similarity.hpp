#pragma once

#include "domain/response/curve.hpp"
#include "domain/target/target.hpp"

#include <algorithm>

namespace rough {

/// Which of the target's points have from <= x <= to, in its unit.
std::vector<Index> points_within(const Target& target, double from, double to);

/// The misfit of a value y at the target's point k: y/y_k - 1, or how far y is outside the band over y_k;
/// times the weight.
inline double misfit(const Target& target, Index k, double y) {
    const double wanted =
        target.has_band() ? std::clamp(y, target.lower[k], target.upper[k]) / target.y[k] : 1;
    return target.weight * (y / target.y[k] - wanted);
}
/// Misfits of a curve at the target's points. Throws InputError where one is outside the curve's range.
Eigen::VectorXd misfit(const Target& target, const Curve& curve);

/// d misfit/dgene, points x genes; zero within the band. `misfits` are the curve's.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const Eigen::VectorXd& misfits);

/// Similarity, Eq. 12, of a curve with these misfits: 1 - the largest |misfit|. Without band and weight s = 1
/// - max_k |y_k - y(x_k)|/|y_k|. 1 is equal; may be negative.
inline double similarity(const Eigen::VectorXd& misfits) { return 1 - misfits.cwiseAbs().maxCoeff(); }
/// Of a curve at all of the target's points.
double similarity(const Target& target, const Curve& curve);

/// How far one response meets another (the first taken as target at its own abscissas, both stretched to the
/// same highest pressure): used to verify a reduced profile against the whole.
double similarity(const Curve& reference, const Curve& curve);

} // namespace rough
