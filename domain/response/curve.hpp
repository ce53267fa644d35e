#pragma once

#include "domain/response/response.hpp"

namespace rough {

/// A piecewise linear curve y(x): linear between its points, continued with the end segments' slopes over
/// [from, to]. At least two points, x increasing.
struct Curve {
    Eigen::VectorXd x; ///< increasing
    Eigen::VectorXd y; ///< one at each x
    double from = 0;   ///< the curve may be read from here
    double to = 0;     ///< to here

    /// y at x. Throws InputError outside [from, to] (with a guard of 1e-9 of its length).
    double at(double position) const;
};

/// Which segment of a curve serves a position, and the weights of its two points.
struct Segment {
    Index left;    ///< points left and left + 1
    double weight; ///< of the right point; outside [0, 1] on a continued segment
};
/// The segment about `position`, or the end segment nearest to it.
Segment segment_at(const Curve& curve, double position);

/// K(p) as it is scored: secants K_j = (P_j - P_{j-1})/(Delta_j - Delta_{j-1}) at pi_j = (P_j + P_{j-1})/2,
/// to be read over [0, P_nt]. Secants, since at a fixed contact set the tangent does not depend on heights.
/// x in MPa, y in MPa/mm.
Curve secant_stiffness(const Response& response);

/// Contact fraction against mean pressure (MPa), from (0, 0).
Curve area_against_pressure(const Response& response);

/// Contact fraction against displacement (mm), from (0, 0).
Curve area_against_displacement(const Response& response);

/// Mean pressure (MPa) against displacement (mm), from (0, 0).
Curve load_against_displacement(const Response& response);

/// The same curve with a point at the end of what may be read, for drawing.
Curve to_its_end(Curve curve);

/// The curve with its x multiplied by `factor`: Eq. 11 takes p_max / P_nt.
Curve stretched(Curve curve, double factor);

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
    Eigen::MatrixXd x, y; ///< points x genes
};

/// d(pi_j, K_j)/dgene of secant_stiffness(response).
CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian);

} // namespace rough
