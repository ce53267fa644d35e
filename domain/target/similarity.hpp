#pragma once

#include "domain/response/curve.hpp"
#include "domain/target/target.hpp"

#include <algorithm>

namespace rough {

/// The misfit of a value y at the target's point k, times the weight. It is y/y_k - 1, or with a band the
/// distance to the band divided by y_k.
inline double misfit(const Target& target, Index k, double y) {
    const double wanted =
        target.has_band() ? std::clamp(y, target.lower[k], target.upper[k]) / target.y[k] : 1;
    return target.weight * (y / target.y[k] - wanted);
}
/// Misfits of a curve at the target's points. Throws InputError if one is outside the curve's range.
Eigen::VectorXd misfit(const Target& target, const Curve& curve);

/// d misfit/dgene, points x genes; zero within the band. `misfits` are the curve's.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const Eigen::VectorXd& misfits);

/// Similarity (Eq. 12) for these misfits: 1 - the largest |misfit|. Without band and weight it is
/// s = 1 - max_k |y_k - y(x_k)|/|y_k|. 1 is equal; it may be negative.
inline double similarity(const Eigen::VectorXd& misfits) { return 1 - misfits.cwiseAbs().maxCoeff(); }
/// Similarity of a curve to the target.
double similarity(const Target& target, const Curve& curve);

/// Similarity of two responses: the first is the target at its abscissas, and both are stretched to the same
/// highest pressure. It compares a reduced profile with the complete one.
double similarity(const Curve& reference, const Curve& curve);

} // namespace rough
