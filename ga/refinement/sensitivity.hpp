#pragma once

#include "ga/problem/problem.hpp"

#include <Eigen/Core>

namespace ga {

/// Residuals r_k of an objective and their derivatives with respect to the genes. For a perfect genome all
/// residuals are 0.
struct Sensitivity {
    Eigen::VectorXd residuals; ///< residuals r, one per point of the objective
    Eigen::MatrixXd jacobian;  ///< dr/dgenes, rows as in r, one column per gene
};

} // namespace ga
