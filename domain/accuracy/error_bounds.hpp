#pragma once

#include "domain/response/response.hpp"

/// @file
/// Bounds, estimates and relative errors of a curve's pressures.
namespace rough {

/// Share of the last pressure, by which the error of a lower pressure is divided.
constexpr double light_load = 0.01;

/// The divisors of a curve's relative errors, one entry per row (load step). In rows whose pressure is below
/// `light` times the last pressure, both members are at least `light` times the last pressure.
struct ErrorScale {
    Eigen::VectorXd pressure;   ///< pressure of the row, MPa
    Eigen::VectorXd difference; ///< difference from the pressure of the row before, MPa
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
    Eigen::VectorXd difference; ///< largest error of each difference from the row before, MPa

    /// The errors if the first `rows` rows are exact. The other rows are all shifted by `offset` (MPa), which
    /// adds |offset| to the errors of their pressures.
    Doubt known_up_to(Index rows, double offset) const;
};
/// The sum of the errors from two independent sources.
Doubt operator+(const Doubt& a, const Doubt& b);

/// The largest errors of pressures whose exact values lie within bounds.
Doubt doubt_of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// The largest errors of the first `count` rows if the error of each displacement is at most its `share`
/// (lemma of README.md).
Doubt solver_doubt(const Response& rows, Index count, const Eigen::VectorXd& share);

/// Largest relative errors of the rows' displacements: the KKT residuals plus the relative distances of the
/// pressures from the requested ones. P is convex, so displacements are off by no larger shares.
Eigen::VectorXd displacement_errors(const Response& rows, const Loading& loading);

/// For each row, the larger of the relative errors of pressure and secant, over the lowest possible exact
/// value (README.md). It is infinite if that value is not positive.
Eigen::VectorXd relative(const Doubt& doubt, const ErrorScale& scale);

/// Number of first rows that must be exact so that the relative errors of the other rows are at most `accuracy`. The
/// other rows are shifted as in known_up_to(). It is the number of all rows if no smaller number is enough.
Index rows_to_know(const Doubt& doubt, const ErrorScale& scale, double accuracy);

/// The largest relative error, over all rows, of pressures and secants against `resolved` pressures at the
/// same displacements.
double relative_error(const Eigen::VectorXd& pressure, const Eigen::VectorXd& resolved);

/// The range of f_i = g0_i - g0'_i over the nodes i. The gaps at first touch are g0_i = max Z - Z_i of the
/// whole profile Z, and g0'_i of a reduced profile.
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

/// Bounds of the whole profile's pressures P at the given displacements Delta (mm, increasing). P' are the
/// pressures of the reduced profile: P'(Delta - highest) <= P(Delta) <= P'(Delta - lowest) (README.md). For
/// the periodic kernel, an upper bound beyond the reduced profile's full contact is infinite.
Bounds pressure_bounds(const Profile& reduced, const Window& window, const Body& body,
                       const std::vector<double>& displacements, const ContactOptions& options = {});

/// The bounds from one curve P' of the reduced profile, for its first `count` load steps. They are P'_j -
/// highest K'_j <= P(Delta_j) <= P'_j - lowest T_j. K'_j is the tangent at step j, T_j that at the first step
/// at or beyond Delta_j - lowest. Without such a step the upper bound is infinite.
Bounds pressure_bounds(const std::vector<LoadStep>& steps, Index count, const Window& window);

/// The pressures that a finer grid would give, from several coarser ones.
struct Extrapolation {
    Eigen::VectorXd pressure; ///< pressure of each row, MPa
    Doubt doubt;              ///< estimated errors, not bounds
};

/// Extrapolates the pressure of each row to a grid of N = `resolved` elements, along a straight line in
/// N^-order with the weights N^3 (README.md). `grids` are the numbers N, at least 3. `pressures` has one row
/// per load step and one column per grid, all at the same displacements.
Extrapolation extrapolate(const std::vector<Index>& grids, const Eigen::MatrixXd& pressures, Index resolved,
                          double order = 1.5);

} // namespace rough
