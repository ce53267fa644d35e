#pragma once

#include "domain/response/similarity.hpp"

namespace rough {

/// Derivatives of a response with respect to genes: rows of ResponseGradient pulled back.
struct ResponseJacobian {
    Eigen::MatrixXd pressure; ///< dP_j/dgene, steps x genes
    Eigen::RowVectorXd range; ///< d range/dgene
};

/// A curve with the derivatives of both its coordinates.
struct CurveJacobian {
    Eigen::MatrixXd x, y; ///< points x genes
};

/// d(pi_j, K_j)/dgene of secant_stiffness(response).
CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian,
                              const Loading& loading);

/// The same for secant_stiffness stretched by p_max/P_nt (Eq. 11): the factor moves with the genes, too.
CurveJacobian rescaled_jacobian(const Response& response, const ResponseJacobian& jacobian,
                                const Loading& loading, double max_pressure);

/// d relative_misfit/dgene at the given points of the target, points x genes.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const std::vector<Index>& points);

} // namespace rough
