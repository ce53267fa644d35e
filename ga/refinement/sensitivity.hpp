#pragma once

#include "ga/problem/problem.hpp"

#include <Eigen/Core>

namespace ga {

/// Residuals r_k of an objective (a perfect genome has none) and their derivatives: rows k, columns genes.
struct Sensitivity {
    Eigen::VectorXd residuals; ///< r, one per point of the objective
    Eigen::MatrixXd jacobian;  ///< dr/dgenes, rows as in r, one column per gene
};

} // namespace ga
