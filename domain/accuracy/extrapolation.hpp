#pragma once

#include "domain/accuracy/error_bounds.hpp"
#include "domain/profile/profile.hpp"

#include <vector>

namespace rough {

/// The pressures that a finer grid would give, verified from several coarser ones.
struct Extrapolation {
    Eigen::VectorXd pressure; ///< MPa, one a row
    Doubt doubt;              ///< estimated
};

/// Straight lines through P_j(N) - P_j ~ N^-1.5, weighted N^3, read at N = resolved.
///
/// Grid errors are not monotone in N: each contact edge falls anywhere between two nodes, so its error is of
/// a random sign, and falls as N^-1.5 to N^-2. Two grids would extrapolate the noise; over several, unequal
/// ones it averages out, and what is left of it tells how far to trust the line. The doubt of a row is the
/// larger of the extrapolated distance and the line's standard error, times 2.3 (3 with three grids): factors
/// tuned on random scenes (README.md).
///
/// `grids` in elements, at least 3; `pressures` one column a grid, all at the same displacements.
Extrapolation extrapolate(const std::vector<Index>& grids, const Eigen::MatrixXd& pressures, Index resolved);

/// The same line for any row of values whose error falls as N^-order.
Eigen::VectorXd extrapolated(const std::vector<Index>& grids, const Eigen::MatrixXd& values, Index resolved,
                             double order);

} // namespace rough
