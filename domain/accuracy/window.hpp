#pragma once

#include "domain/profile/profile.hpp"
#include "domain/response/response.hpp"

namespace rough {

/// How far the gaps of a reduced profile Z' are off those of the whole profile Z, mm: the least and the
/// greatest of f_i = (Z'_i - max Z') - (Z_i - max Z) = g0_i - g0'_i over the nodes; lowest <= 0 <= highest.
struct Window {
    double lowest = 0;                                ///< mm, <= 0
    double highest = 0;                               ///< mm, >= 0
    double width() const { return highest - lowest; } ///< mm, >= 0
};

/// Both profiles on the same nodes. Throws InputError if they are not.
Window window_between(const Profile& whole, const Profile& reduced);

/// Values that are certainly not below `lower` nor above `upper`, one a load step. `upper` may be infinite.
struct Bounds {
    Eigen::VectorXd lower; ///< one a load step
    Eigen::VectorXd upper; ///< one a load step, no less than `lower`
};

/// Bounds of the whole profile's pressures P(Delta_j), MPa, at the displacements given (mm, increasing), from
/// two curves of the reduced profile:
///
///     P'(Delta - highest) <= P(Delta) <= P'(Delta - lowest).
///
/// Periodic: unbounded where Delta - lowest passes the reduced profile's full contact. Proof in README.md.
Bounds pressure_bounds(const Profile& reduced, const Window& window, const Body& body,
                       const std::vector<double>& displacements, const ContactOptions& options = {});

/// The same from one curve of the reduced profile, P'(Delta_j) with tangents K'_j, and one step more at
/// Delta_n - lowest or beyond: P' is convex, so
///
///     P'_j - highest K'_j <= P'(Delta_j - highest),   P'(Delta_j - lowest) <= P'_j - lowest K'_j+
///
/// where K'_j+ is the tangent at the first solved step at or beyond Delta_j - lowest; infinite if there is
/// none. `steps` are the curve's, the bounds are given for the first `count` of them.
Bounds pressure_bounds(const std::vector<LoadStep>& steps, Index count, const Window& window);

} // namespace rough
