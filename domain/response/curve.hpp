#pragma once

#include "domain/response/response.hpp"

namespace rough {

/// A curve y(x) of at least two points. It is linear between its points, and continued with the slopes of its
/// end segments to [from, to].
struct Curve {
    Eigen::VectorXd x; ///< x of the points, increasing
    Eigen::VectorXd y; ///< y of the points
    double from = 0;   ///< smallest x at which the curve is defined
    double to = 0;     ///< largest x at which the curve is defined

    /// y at a position. Throws InputError outside [from, to] (with a margin of 1e-9 of its length).
    double at(double position) const;
};

/// A segment of a curve, and a position on it.
struct Segment {
    Index left;    ///< index of the left point; the right point is the next one
    double weight; ///< weight of the right point at the position; outside [0, 1] beyond the segment's ends
};
/// The segment that contains `position`, or the nearest end segment.
Segment segment_at(const Curve& curve, double position);

/// The stiffness curve K(p) from which similarities are computed: the secants K_j (MPa/mm) at pi_j (MPa) of
/// README.md, on [0, P_nt].
Curve secant_stiffness(const Response& response);

/// Contact fraction against mean pressure (MPa), from (0, 0).
Curve area_against_pressure(const Response& response);

/// The curve y(x) that begins at (0, 0) and ends at the last point.
Curve from_origin(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// The curve with an additional point at `to`, for plots.
Curve to_its_end(Curve curve);

/// The curve with x multiplied by `factor`. For Eq. 11 the factor is p_max/P_nt.
Curve stretched(Curve curve, double factor);

/// The derivatives with respect to genes; `pull` (pulled_back) converts rows x N to rows x genes.
template <class Pull>
ResponseJacobian in_genes(const ResponseJacobian& gradient, Pull pull) {
    const auto& [pressure, last_displacement, fraction] = gradient;
    const Index steps = pressure.rows();
    Eigen::MatrixXd rows(steps + 1 + fraction.rows(), pressure.cols());
    rows.topRows(steps) = pressure;
    rows.row(steps) = last_displacement;
    if (fraction.size() > 0) rows.bottomRows(fraction.rows()) = fraction;
    const Eigen::MatrixXd pulled = pull(rows);
    return {pulled.topRows(steps), pulled.row(steps), pulled.bottomRows(fraction.rows())};
}

/// A curve with the derivatives of both its coordinates.
struct CurveJacobian {
    Eigen::MatrixXd x; ///< dx/dgene, points x genes
    Eigen::MatrixXd y; ///< dy/dgene, points x genes
};

/// d(pi_j, K_j)/dgene of secant_stiffness(response).
CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian);

/// The interface stiffness K_i at each load step, MPa/mm, from the tangent K: 1/K_i = 1/K - 1/K_full (Barber
/// 2003; README.md). It is infinite at full contact, and K on a periodic half-plane.
Eigen::VectorXd interface_stiffness(const Response& response);

/// The interface stiffness K_i for a stiffness K, both in MPa/mm. If K is within a relative 1e-12 of K_full,
/// K_i is 1e12 K.
double interface_of(double stiffness, double full_stiffness);
/// The derivatives of K_i from those of `stiffness`; zero if K_i is 1e12 K.
CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness);

/// The curve of K_i against mean pressure from which similarities are computed. Its points follow from the
/// secants of secant_stiffness().
Curve interface_secants(const Response& response);

/// A tangential load-displacement curve under a constant normal load P (README.md, Partial slip), from stick
/// (Q = 0) to full slip (Q = f P). It has one row more than the load steps.
struct PartialSlip {
    Eigen::VectorXd displacement;   ///< tangential displacement, mm
    Eigen::VectorXd traction;       ///< Q as a mean over the length, MPa
    Eigen::VectorXd stiffness;      ///< dQ/d displacement, MPa/mm; 0 at full slip
    Eigen::VectorXd stick_fraction; ///< share of the touching nodes that stick
};

/// The assumptions of the curve for this body, in words.
std::string slip_assumption(const Body& body, bool is_2d);

/// The curve under the last normal load of a surface's response (README.md). On a half-space row k has P* =
/// P_(n-k), and displacements have the datum of the normal ones. A strip's and a layered line's is that of
/// solve_partial_slip(), in even steps. Throws what that throws; InputError if the friction coefficient is
/// not positive and finite, nodes are at the hardness, or a map has layers.
PartialSlip partial_slip(const Profile& surface, const Body& body, const Response& response, double friction,
                         const ContactOptions& options = {});

} // namespace rough
