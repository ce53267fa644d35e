#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// First and second derivatives of a surface by the seven-point formulas of ISO 21920-2 (exact for
/// polynomials up to degree 6), columns x rows: at the nodes that are three or more from every end, and at
/// all where the surface is periodic. Of a line only those along x.
struct Derivatives {
    Eigen::ArrayXXd x;  ///< dz/dx
    Eigen::ArrayXXd y;  ///< dz/dy; empty of a line
    Eigen::ArrayXXd xx; ///< d2z/dx2, 1/mm
    Eigen::ArrayXXd yy; ///< d2z/dy2, 1/mm; empty of a line
};
/// Throws InputError on fewer than seven nodes along x or y.
Derivatives derivatives(const Profile& surface, bool periodic = false);

} // namespace rough
