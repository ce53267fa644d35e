#include "domain/response/curve.hpp"

#include "domain/errors.hpp"

namespace rough {
namespace {

/// Row j - 1 in place of each row j; zeros in place of the first.
Eigen::MatrixXd rows_before(const Eigen::MatrixXd& rows) {
    Eigen::MatrixXd before = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
    before.bottomRows(rows.rows() - 1) = rows.topRows(rows.rows() - 1);
    return before;
}

/// Rounding error of 1 - K/K_full.
constexpr double rounding = 1e-12;

/// Whether tangential compliances are the normal ones (lines) or proportional to them at round spots (maps).
bool is_half_space(const Body& body) { return body.kernel != Kernel::strip && body.layering.layers.empty(); }

/// K/K_i = 1 - K/K_full, or 0 if it is only rounding.
double interface_share(double stiffness, double full_stiffness) {
    if (std::isnan(full_stiffness))
        throw std::logic_error("interface stiffness of a response without its full contact's stiffness");
    const double share = 1 - stiffness / full_stiffness;
    return share > rounding ? share : 0;
}

} // namespace

Segment segment_at(const Curve& curve, double position) {
    const double* begin = curve.x.data();
    const double* end = begin + curve.x.size();
    const Index above = std::upper_bound(begin, end, position) - begin;
    const Index left = std::clamp<Index>(above - 1, 0, curve.x.size() - 2);
    return {left, (position - curve.x[left]) / (curve.x[left + 1] - curve.x[left])};
}

double Curve::at(double position) const {
    const double guard = 1e-9 * (to - from);
    if (!(position >= from - guard && position <= to + guard))
        refuse("curve: ", position, " is out of range (", from, " to ", to, ")");
    const Segment s = segment_at(*this, position);
    return (1 - s.weight) * y[s.left] + s.weight * y[s.left + 1];
}

Curve secant_stiffness(const Response& response) {
    const Eigen::VectorXd &P = response.pressure, &D = response.displacement;
    const Eigen::VectorXd P_before = rows_before(P);
    return {0.5 * (P + P_before), (P - P_before).cwiseQuotient(D - rows_before(D)), 0, P[P.size() - 1]};
}

CurveJacobian secant_jacobian(const Response& response, const ResponseJacobian& jacobian) {
    const Eigen::VectorXd &P = response.pressure, &D = response.displacement;
    const Eigen::VectorXd step = D - rows_before(D), K = (P - rows_before(P)).cwiseQuotient(step);
    const Eigen::MatrixXd &dP = jacobian.pressure, dP_before = rows_before(dP);
    // All steps are parts of the last displacement: dK = (dP_j - dP_{j-1} - K d step)/step.
    const double last = D[response.steps() - 1];
    const Eigen::MatrixXd rise = dP - dP_before - K.cwiseProduct(step) / last * jacobian.last_displacement;
    return {0.5 * (dP + dP_before), rise.array().colwise() / step.array()};
}

Curve area_against_pressure(const Response& response) {
    return from_origin(response.pressure, response.contact_fraction);
}

Curve from_origin(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    const Index n = x.size();
    Curve curve{Eigen::VectorXd(n + 1), Eigen::VectorXd(n + 1), 0, x[n - 1]};
    curve.x << 0, x;
    curve.y << 0, y;
    return curve;
}

Curve to_its_end(Curve curve) {
    const Index last = curve.x.size();
    if (curve.x[last - 1] < curve.to) {
        const double y = curve.at(curve.to);
        curve.x.conservativeResize(last + 1);
        curve.y.conservativeResize(last + 1);
        curve.x[last] = curve.to;
        curve.y[last] = y;
    }
    return curve;
}

Curve stretched(Curve curve, double factor) {
    curve.x *= factor;
    curve.from *= factor;
    curve.to *= factor;
    return curve;
}

Eigen::VectorXd interface_stiffness(const Response& response) {
    Eigen::VectorXd result(response.steps());
    for (Index j = 0; j < response.steps(); ++j) {
        const double K = response.tangent_stiffness[j], share = interface_share(K, response.full_stiffness);
        const bool full = response.contact_fraction[j] == 1 && response.held_nodes == 0;
        result[j] = K == 0 ? 0 : full || share == 0 ? std::numeric_limits<double>::infinity() : K / share;
    }
    return result;
}

double interface_of(double stiffness, double full_stiffness) {
    return stiffness / std::max(interface_share(stiffness, full_stiffness), rounding);
}

CurveJacobian interface_jacobian(CurveJacobian jacobian, const Curve& stiffness, double full_stiffness) {
    for (Index j = 0; j < stiffness.y.size(); ++j) {
        // dK_i = (K_i/K)^2 dK, as d(1/K_i) = d(1/K)
        const double share = interface_share(stiffness.y[j], full_stiffness);
        jacobian.y.row(j) *= share > 0 ? 1 / (share * share) : 0;
    }
    return jacobian;
}

Curve interface_secants(const Response& response) {
    Curve curve = secant_stiffness(response);
    for (double& K : curve.y) K = interface_of(K, response.full_stiffness);
    return curve;
}

std::string slip_assumption(const Body& body, bool is_2d) {
    const std::string load = "a constant normal load, tractions along x";
    if (is_half_space(body))
        return load + (is_2d ? ", round spots" : ", plane strain") +
               ", bodies that do not couple (equal ones, or Dundurs' beta = 0; a rigid profile at nu = 0.5 "
               "only)";
    return load + ", |q| <= f p at every node with the body's tangential compliance; coupling with the "
                  "pressures is neglected";
}

PartialSlip partial_slip(const Profile& surface, const Body& body, const Response& response, double friction,
                         const ContactOptions& options) {
    if (!(friction > 0) || !std::isfinite(friction))
        refuse("friction coefficient ", friction, " is out of range (above 0, finite)");
    if (response.held_nodes > 0)
        refuse("partial slip: ", response.held_nodes, " nodes are at the hardness; use a profile in elastic contact");
    const Index n = response.steps();
    if (!is_half_space(body)) {
        if (surface.is_2d())
            refuse("partial slip: a map with layers has no tangential solution; use a line or no layers");
        const std::vector<LoadStep> rows =
            solve_partial_slip(surface, body, response.displacement[n - 1], friction, static_cast<int>(n), options);
        const Response slip = response_of(rows, response.solver, 1);
        Eigen::VectorXd stick(n + 1);
        for (Index k = 0; k <= n; ++k) {
            const LoadStep& row = rows[static_cast<std::size_t>(k)];
            stick[k] = 1 - static_cast<double>(row.held_nodes) / static_cast<double>(row.contact_nodes);
        }
        return {slip.displacement, slip.pressure, slip.tangent_stiffness, stick};
    }
    const auto backwards = [n](const Eigen::VectorXd& values) {
        Eigen::VectorXd rows(n + 1);
        rows << values.reverse(), 0;
        return rows;
    };
    const auto slipped = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
        return friction * (values[n - 1] - backwards(values).array());
    };
    return {slipped(response.displacement), slipped(response.pressure), backwards(response.tangent_stiffness),
            backwards(response.contact_fraction) / response.contact_fraction[n - 1]};
}

} // namespace rough
