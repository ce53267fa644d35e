#pragma once

#include "domain/response/similarity.hpp"

namespace rough {

/// Derivatives of a response with respect to genes: rows of ResponseGradient pulled back.
struct ResponseJacobian {
    Eigen::MatrixXd pressure;             ///< dP_j/dgene, steps x genes
    Eigen::RowVectorXd last_displacement; ///< d Delta_nt/dgene
};

/// Pulled back from heights to genes: `pull` takes rows x N to rows x genes.
template <class Pull>
ResponseJacobian in_genes(const ResponseGradient& gradient, Pull pull) {
    Eigen::MatrixXd rows(gradient.pressure.rows() + 1, gradient.pressure.cols());
    rows << gradient.pressure, gradient.last_displacement;
    const Eigen::MatrixXd pulled = pull(rows);
    return {pulled.topRows(gradient.pressure.rows()), pulled.bottomRows(1)};
}

/// A curve with the derivatives of both its coordinates.
struct CurveJacobian {
    /// points x genes: derivatives of the abscissas and of the values
    Eigen::MatrixXd x, y; ///< points x genes
};

/// d(pi_j, K_j)/dgene of secant_stiffness(response).
CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian);

/// The same for secant_stiffness stretched by p_max/P_nt (Eq. 11): the factor moves with the genes, too.
CurveJacobian rescaled_jacobian(const Response& response, const ResponseJacobian& jacobian,
                                double max_pressure);

/// d relative_misfit/dgene at the given points of the target, points x genes.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const std::vector<Index>& points);

} // namespace rough
