#pragma once

#include <Eigen/Core>

namespace rough {

/// Pressures under this part of the last one are judged against it, not against themselves.
constexpr double light_load = 0.01;

/// What relative errors of a curve are relative to: at each row its pressure, and the difference to the row
/// before (the secant stiffness times the row's step); where the pressure is under 1 % of the last, no less
/// than that 1 %. MPa.
struct ErrorScale {
    Eigen::VectorXd pressure, difference;
};
ErrorScale error_scale(const Eigen::VectorXd& pressure);

/// P_j - P_{j-1}, P_0 = 0.
Eigen::VectorXd differences(const Eigen::VectorXd& pressure);

/// The largest relative error over the rows, in pressure and in secant stiffness, of pressures against
/// resolved ones at the same displacements.
double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved);

} // namespace rough
