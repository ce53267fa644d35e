#pragma once

#include "domain/response/curve.hpp"

namespace rough {

/// Derivatives of a response with respect to genes: rows of ResponseGradient pulled back.
struct ResponseJacobian {
    Eigen::MatrixXd pressure;             ///< dP_j/dgene, steps x genes
    Eigen::RowVectorXd last_displacement; ///< d Delta_nt/dgene
    Eigen::MatrixXd contact_fraction;     ///< of the smooth one, steps x genes; empty where not asked for
};

/// Pulled back from heights to genes: `pull` takes rows x N to rows x genes.
template <class Pull>
ResponseJacobian in_genes(const ResponseGradient& gradient, Pull pull, const AreaGradient& area = {}) {
    const Index steps = gradient.pressure.rows();
    Eigen::MatrixXd rows(steps + 1 + area.by_heights.rows(), gradient.pressure.cols());
    rows.topRows(steps) = gradient.pressure;
    rows.row(steps) = gradient.last_displacement;
    if (area.by_heights.size() > 0)
        rows.bottomRows(area.by_heights.rows()) = area.by_heights;
    const Eigen::MatrixXd pulled = pull(rows);
    return {pulled.topRows(steps), pulled.row(steps), pulled.bottomRows(area.by_heights.rows())};
}

/// A curve with the derivatives of both its coordinates.
struct CurveJacobian {
    /// points x genes: derivatives of the abscissas and of the values
    Eigen::MatrixXd x, y; ///< points x genes
};

/// d(pi_j, K_j)/dgene of secant_stiffness(response).
CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian);

} // namespace rough
