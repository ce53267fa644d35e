#pragma once

#include "domain/profile/profile.hpp"
#include "domain/response/response.hpp"

#include <vector>

/// @file
/// Bounds, estimates and relative errors of a curve's pressures.
namespace rough {

/// Errors of pressures below this share of the last pressure are relative to that share of it.
constexpr double light_load = 0.01;

/// The pressures to which relative errors of a curve refer, one entry per row (load step). In rows whose
/// pressure is below `light` times the last pressure, both are at least `light` times the last pressure.
struct ErrorScale {
    Eigen::VectorXd pressure;   ///< pressure of the row, MPa
    Eigen::VectorXd difference; ///< its difference from the row before, MPa
};
/// The scale of a curve's pressures (MPa, increasing).
ErrorScale error_scale(const Eigen::VectorXd& pressure, double light = light_load);

/// Number of first rows whose pressure is below 1 % of the last pressure.
Index light_rows(const Eigen::VectorXd& pressure);

/// The differences P_j - P_{j-1} of successive pressures, with P_0 = 0.
Eigen::VectorXd differences(const Eigen::VectorXd& pressure);

/// Largest possible errors of pressures and of their differences from row to row.
struct Doubt {
    Eigen::VectorXd pressure;   ///< largest error of each row's pressure, MPa
    Eigen::VectorXd difference; ///< largest error of its difference from the row before, MPa

    /// The errors if the first `rows` rows are known and the other rows are shifted by `offset` (MPa) to join
    /// them.
    Doubt known_up_to(Index rows, double offset) const;
};
/// The sum of the errors from two independent sources.
Doubt operator+(const Doubt& a, const Doubt& b);

/// The largest errors of pressures whose exact values lie within bounds.
Doubt doubt_of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// Each row's largest error, relative to the exact pressure and secant. The exact values may be below the
/// curve's by `doubt`. The error is infinite if they may be 0.
Eigen::VectorXd relative(const Doubt& doubt, const ErrorScale& scale);

/// Number of first rows that must be known so that the other rows, shifted to join them, are within
/// `accuracy`. It is the number of all rows if fewer known rows are not enough.
Index rows_to_know(const Doubt& doubt, const ErrorScale& scale, double accuracy);

/// The largest relative error of pressures against `resolved` pressures at the same displacements. It is the
/// largest over all rows and over pressure and secant stiffness.
double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved);

/// The range of f_i = g0_i - g0'_i over the nodes i. g0_i = max Z - Z_i is the gap of the whole profile Z at
/// first touch. g0'_i = max Z' - Z'_i is that of a reduced profile Z'.
struct Window {
    double lowest = 0;                                ///< lowest f_i, mm, <= 0
    double highest = 0;                               ///< highest f_i, mm, >= 0
    double width() const { return highest - lowest; } ///< width of the range, mm, >= 0
};
/// The window of two profiles on the same nodes. Throws InputError if the nodes differ.
Window window_between(const Profile& whole, const Profile& reduced);

/// Bounds of the exact pressures, one entry per load step, MPa.
struct Bounds {
    Eigen::VectorXd lower; ///< lower bounds, MPa
    Eigen::VectorXd upper; ///< upper bounds, MPa, at least `lower`; they may be infinite
};

/// Bounds of the whole profile's pressures P(Delta_j) at the given displacements (mm, increasing), from two
/// curves of the reduced profile:
///
///     P'(Delta - highest) <= P(Delta) <= P'(Delta - lowest).
///
/// For the periodic kernel, the upper bound is infinite if Delta - lowest exceeds the reduced profile's full
/// contact. README.md has the proof.
Bounds pressure_bounds(const Profile& reduced, const Window& window, const Body& body,
                       const std::vector<double>& displacements, const ContactOptions& options = {});

/// Bounds of the whole profile's pressures from one curve of the reduced profile, P'(Delta_j) with tangents
/// K'_j. It needs one additional step, at Delta_n - lowest or beyond. P' is convex, so
///
///     P'_j - highest K'_j <= P'(Delta_j - highest),   P'(Delta_j - lowest) <= P'_j - lowest K'_j+
///
/// K'_j+ is the tangent at the first solved step at or beyond Delta_j - lowest. The upper bound is infinite
/// without such a step. `steps` are the load steps of the reduced profile's curve. Bounds are returned for
/// the first `count` of them.
Bounds pressure_bounds(const std::vector<LoadStep>& steps, Index count, const Window& window);

/// The pressures that a finer grid would give, from several coarser ones.
struct Extrapolation {
    Eigen::VectorXd pressure; ///< pressure of each row, MPa
    Doubt doubt;              ///< estimated errors, not bounds
};

/// Extrapolates pressures along straight lines P_j(N) - P_j ~ N^-1.5, weighted by N^3, to N = `resolved`. N
/// is the number of elements of a grid.
///
/// Grid errors are not monotone in N. Each contact edge falls anywhere between two nodes, so its error has a
/// random sign. The size of the error falls as N^-1.5 to N^-2. Two grids would extrapolate this scatter. Over
/// more grids the scatter averages out, and its size shows the error of the line. The doubt of a row is the
/// larger of the extrapolated distance and the line's standard error, times 2.3. With three grids the factor
/// is 3. Both factors were tuned on random scenes (README.md).
///
/// `grids` has at least 3 entries; `pressures` has one column per grid, all at the same displacements. Other
/// quantities are extrapolated along lines in N^-order.
Extrapolation extrapolate(const std::vector<Index>& grids, const Eigen::MatrixXd& pressures, Index resolved,
                          double order = 1.5);

} // namespace rough
