#include "domain/response/response.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rough {

namespace {

Response from_curve(const ContactCurve& curve, double range) {
    const auto count = static_cast<Index>(curve.steps.size());
    Response response{range, {}, {}, {}, {}, {}, curve.solver};
    for (auto* column : {&response.displacement, &response.pressure, &response.contact_fraction,
                         &response.tangent_stiffness, &response.kkt_residual})
        column->resize(count);
    for (Index j = 0; j < count; ++j) {
        const LoadStep& step = curve.steps[static_cast<std::size_t>(j)];
        response.displacement[j] = step.displacement;
        response.pressure[j] = step.pressure;
        response.contact_fraction[j] = step.contact_fraction;
        response.tangent_stiffness[j] = step.tangent_stiffness;
        response.kkt_residual[j] = step.kkt_residual;
    }
    return response;
}

} // namespace

double displacement_range(const Profile& profile, Kernel kernel) {
    if (profile.nodes() < 2)
        throw InputError("profile: " + std::to_string(profile.nodes()) + " nodes given, expected at least 2");
    if (!profile.heights.allFinite())
        throw InputError("profile: a height is not finite, expected finite heights in mm");
    const double highest = profile.heights.maxCoeff();
    const double range =
        highest - (kernel == Kernel::periodic ? profile.heights.mean() : profile.heights.minCoeff());
    if (!(range > 0))
        throw InputError(
            "profile: all heights are equal at its nodes, expected a height range greater than 0");
    return range;
}

std::vector<double> load_displacements(double range, const Loading& loading, Kernel kernel) {
    if (loading.steps < 2)
        throw InputError("steps: " + std::to_string(loading.steps) + " given, expected at least 2");
    const bool periodic = kernel == Kernel::periodic;
    if (!(loading.reach > 0) || loading.reach > 1 || (periodic && loading.reach == 1))
        throw InputError("reach: " + std::to_string(loading.reach) + " given, expected more than 0 and " +
                         (periodic ? "less than 1 (periodic kernel)" : "at most 1"));
    std::vector<double> displacements;
    for (int j = 1; j <= loading.steps; ++j)
        displacements.push_back(loading.reach * j / loading.steps * range);
    return displacements;
}

Response respond(const Profile& profile, const Body& body, const Loading& loading,
                 const ContactOptions& options) {
    const double range = displacement_range(profile, body.kernel);
    return from_curve(solve_contact(profile, body, load_displacements(range, loading, body.kernel), options),
                      range);
}

ResponseWithGradient respond_with_gradient(const Profile& profile, const Body& body, const Loading& loading,
                                           ContactOptions options) {
    const double range = displacement_range(profile, body.kernel);
    options.states = true;
    const ContactCurve curve =
        solve_contact(profile, body, load_displacements(range, loading, body.kernel), options);
    const Index nodes = profile.nodes(), steps = static_cast<Index>(curve.steps.size());

    // The functional `range`: +1 at the first highest node, -1 at the first lowest (periodic: -1/N
    // everywhere).
    Index highest = 0, lowest = 0;
    profile.heights.maxCoeff(&highest);
    profile.heights.minCoeff(&lowest);
    Eigen::RowVectorXd d_range = Eigen::RowVectorXd::Zero(nodes);
    if (body.kernel == Kernel::periodic)
        d_range.setConstant(-1.0 / static_cast<double>(nodes));
    else
        d_range[lowest] -= 1;
    d_range[highest] += 1;

    // dP_j = (delta/L) [ w.dZ - sum(w) dZ_max + sum(w) t_j d range ], where (delta/L) sum(w) is the tangent
    // stiffness.
    Eigen::MatrixXd d_pressure = Eigen::MatrixXd::Zero(steps, nodes);
    for (Index j = 0; j < steps; ++j) {
        const ContactState& state = curve.states[static_cast<std::size_t>(j)];
        const LoadStep& step = curve.steps[static_cast<std::size_t>(j)];
        const double t = loading.reach * static_cast<double>(j + 1) / loading.steps;
        const double cell = step.tangent_stiffness / state.tangent.sum(); // delta/L
        d_pressure.row(j) = step.tangent_stiffness * t * d_range;
        d_pressure(j, highest) -= step.tangent_stiffness;
        for (std::size_t i = 0; i < state.nodes.size(); ++i)
            d_pressure(j, state.nodes[i]) += cell * state.tangent[static_cast<Index>(i)];
    }
    return {from_curve(curve, range), {std::move(d_pressure), std::move(d_range)}};
}

Response scaled(Response response, double factor) {
    response.range *= factor;
    response.displacement *= factor;
    response.pressure *= factor;
    return response;
}

} // namespace rough
