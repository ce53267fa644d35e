#pragma once

#include <Eigen/Core>

namespace rough {

/// Pressures under this part of the last one are verified against it, not against themselves.
constexpr double light_load = 0.01;

/// What relative errors of a curve are relative to: at each row its pressure, and the difference to the row
/// before (the secant stiffness times the row's step); if the pressure is below `light` of the last one, no
/// less than that part of it. MPa.
struct ErrorScale {
    Eigen::VectorXd pressure;   ///< MPa, one a row
    Eigen::VectorXd difference; ///< MPa, one a row
};
/// The scale of a curve's pressures (MPa, increasing).
ErrorScale error_scale(const Eigen::VectorXd& pressure, double light = light_load);

/// How many of the first rows have less than 1 % of the last pressure.
Eigen::Index light_rows(const Eigen::VectorXd& pressure);

/// P_j - P_{j-1}, P_0 = 0.
Eigen::VectorXd differences(const Eigen::VectorXd& pressure);

/// How far off pressures and their differences from row to row may be, MPa.
struct Doubt {
    Eigen::VectorXd pressure;   ///< MPa, one a row
    Eigen::VectorXd difference; ///< MPa, one a row

    /// Without any in the first rows, which are known; the others moved by `offset` (MPa) to join them.
    Doubt known_up_to(Eigen::Index rows, double offset) const;
};
/// Doubts of independent sources add up.
Doubt operator+(const Doubt& a, const Doubt& b);

/// The doubt of pressures whose exact values lie within bounds.
Doubt doubt_of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// Each row's largest error over the exact pressure and secant, which may be as much below the curve's as the
/// doubt says; infinite if they may be 0.
Eigen::VectorXd relative(const Doubt& doubt, const ErrorScale& scale);

/// How many of the first rows must be known for the others, moved to join the last of them, to be within
/// `accuracy`; all of them where nothing less will do.
Eigen::Index rows_to_know(const Doubt& doubt, const ErrorScale& scale, double accuracy);

/// The largest relative error over the rows, in pressure and in secant stiffness, of pressures against
/// resolved ones at the same displacements.
double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved);

} // namespace rough
