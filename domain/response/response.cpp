#include "domain/response/response.hpp"

#include "domain/contact/interface.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"

#include <cstdio>
#include <numeric>

namespace rough {

Response response_of(const std::vector<LoadStep>& steps, Solver solver, double range, double full_stiffness) {
    const auto all = [&](auto LoadStep::*member) {
        Eigen::VectorXd values(static_cast<Index>(steps.size()));
        std::transform(steps.begin(), steps.end(), values.begin(),
                       [&](const LoadStep& step) { return static_cast<double>(step.*member); });
        return values;
    };
    return {range,
            all(&LoadStep::displacement),
            all(&LoadStep::pressure),
            all(&LoadStep::contact_fraction),
            all(&LoadStep::tangent_stiffness),
            all(&LoadStep::kkt_residual),
            solver,
            full_stiffness,
            steps.empty() ? 0 : steps.back().held_nodes,
            all(&LoadStep::largest_pressure),
            all(&LoadStep::spot_width)};
}

Response merged(const Response& a, const Response& b) {
    Response all = a;
    std::vector<Index> order(static_cast<std::size_t>(a.steps() + b.steps()));
    std::iota(order.begin(), order.end(), 0);
    Eigen::VectorXd at(a.steps() + b.steps());
    at << a.displacement, b.displacement;
    std::ranges::sort(order, {}, [&](Index j) { return at[j]; });
    for (auto column :
         {&Response::displacement, &Response::pressure, &Response::contact_fraction, &Response::tangent_stiffness,
          &Response::kkt_residual, &Response::largest_pressure, &Response::spot_width}) {
        at << a.*column, b.*column;
        all.*column = at(order);
    }
    return all;
}

double displacement_range(const Profile& profile, Kernel kernel) {
    if (profile.nodes() < 2)
        throw InputError("profile: it has " + std::to_string(profile.nodes()) + " nodes; use at least 2");
    if (!profile.heights.allFinite()) throw InputError("profile: a height is not finite; use finite heights in mm");
    const Eigen::ArrayXd below = profile.heights.maxCoeff() - profile.heights.array();
    const double range = kernel == Kernel::periodic ? below.mean() : below.maxCoeff();
    if (!(range > 0)) throw InputError("profile: all heights are equal at its nodes; use heights that differ");
    return range;
}

namespace {

std::vector<double> even_steps(double last, const Loading& loading) {
    std::vector<double> displacements = loading.shares;
    for (double& share : displacements) share *= last;
    if (!displacements.empty()) return displacements;
    for (int j = 1; j <= loading.steps; ++j) displacements.push_back(last * (static_cast<double>(j) / loading.steps));
    return displacements;
}

void expect_smooth_area(const Body& body) {
    if (body.yields())
        refuse("hardness: the contact fraction has no gradient with a hardness, ", body.hardness,
               " MPa; use a body without");
}

} // namespace

double reach_of(const Loading& loading, Kernel kernel) {
    return loading.reach.value_or(kernel == Kernel::periodic ? 0.95 : 1);
}

void validate(const Loading& loading, Kernel kernel) {
    if (loading.steps < 2 && loading.pressures.empty())
        refuse_value("steps", loading.steps, " is out of range (at least 2)");
    const bool periodic = kernel == Kernel::periodic;
    const double reach = reach_of(loading, kernel);
    if (!(reach > 0) || reach > 1 || (periodic && reach == 1))
        refuse_value("reach", reach, " is out of range (above 0, ",
                     periodic ? "less than 1: the periodic half-plane has no solution beyond full contact)"
                              : "at most 1)");
}

std::vector<double> load_displacements(double range, const Loading& loading, Kernel kernel) {
    validate(loading, kernel);
    return even_steps(reach_of(loading, kernel) * range, loading);
}

std::vector<double> step_displacements(const Profile& profile, const Body& body, const Loading& loading,
                                       const ContactOptions& options) {
    if (!loading.pressures.empty())
        return column(solve_contact_at_pressures(profile, body, loading.pressures, options).steps,
                      &LoadStep::displacement);
    validate(loading, body.kernel);
    if (loading.to_displacement) return even_steps(*loading.to_displacement, loading);
    if (loading.to_pressure)
        return even_steps(displacement_at_pressure(profile, body, *loading.to_pressure, options), loading);
    return load_displacements(displacement_range(profile, body.kernel), loading, body.kernel);
}

ContactCurve solve_load_steps(const Profile& profile, const Body& body, const Loading& loading,
                              const ContactOptions& options) {
    if (!loading.pressures.empty()) return solve_contact_at_pressures(profile, body, loading.pressures, options);
    return solve_contact(profile, body, step_displacements(profile, body, loading, options), options);
}

Response respond(const Profile& profile, const Body& body, const Loading& loading, const ContactOptions& options) {
    const double range = displacement_range(profile, body.kernel);
    const ContactCurve curve = solve_load_steps(profile, body, loading, options);
    return response_of(curve.steps, curve.solver, range, full_contact_stiffness(profile, body, options.threads));
}

Response respond_smoothly(const Profile& profile, const Body& body, const Loading& loading, ContactOptions options) {
    expect_smooth_area(body);
    const double range = displacement_range(profile, body.kernel);
    options.states = true;
    const ContactCurve curve = solve_load_steps(profile, body, loading, options);
    Response response =
        response_of(curve.steps, curve.solver, range, full_contact_stiffness(profile, body, options.threads));
    response.contact_fraction = smooth_area(profile, body, curve, false).fraction;
    return response;
}

ResponseWithGradient respond_with_gradient(const Profile& profile, const Body& body, const Loading& loading,
                                           ContactOptions options, bool with_area) {
    if (!loading.pressures.empty())
        refuse("pressures: load steps at given pressures have no gradient; use steps of equal displacement");
    if (with_area) expect_smooth_area(body);
    const double range = displacement_range(profile, body.kernel);
    options.states = true;
    const ContactCurve curve = solve_load_steps(profile, body, loading, options);
    const Index nodes = profile.nodes(), steps = static_cast<Index>(curve.steps.size());
    Index highest = 0, lowest = 0;
    profile.heights.maxCoeff(&highest);
    profile.heights.minCoeff(&lowest);

    // Derivatives of Delta_last. By pressure: 0 = w.dZ - sum(w) dZ_max + sum(w) dDelta at the last step. By
    // reach: +reach at the first highest node, -reach at the first lowest (periodic: -reach/N everywhere).
    Eigen::RowVectorXd d_last = Eigen::RowVectorXd::Zero(nodes);
    if (!loading.to_displacement) {
        if (loading.to_pressure) {
            const ContactState& state = curve.states.back();
            for (std::size_t i = 0; i < state.nodes.size(); ++i)
                d_last[state.nodes[i]] -= state.tangent[static_cast<Index>(i)] / state.tangent.sum();
            d_last[highest] += 1;
        } else {
            const double reach = reach_of(loading, body.kernel);
            if (body.kernel == Kernel::periodic)
                d_last.setConstant(-reach / static_cast<double>(nodes));
            else
                d_last[lowest] -= reach;
            d_last[highest] += reach;
        }
    }

    const auto share = [&](Index j) {
        return curve.steps[static_cast<std::size_t>(j)].displacement / curve.steps.back().displacement;
    };
    // dP_j = (delta/L) [ w.dZ - sum(w) dZ_max + sum(w) Delta_j/Delta_last dDelta_last ], where (delta/L) sum(w) is the
    // tangent stiffness.
    Eigen::MatrixXd d_pressure = Eigen::MatrixXd::Zero(steps, nodes);
    for (Index j = 0; j < steps; ++j) {
        const ContactState& state = curve.states[static_cast<std::size_t>(j)];
        const LoadStep& step = curve.steps[static_cast<std::size_t>(j)];
        if (step.tangent_stiffness == 0) // every node is held
            continue;
        const double cell = step.tangent_stiffness / state.tangent.sum(); // delta/L
        d_pressure.row(j) = step.tangent_stiffness * share(j) * d_last;
        d_pressure(j, highest) -= step.tangent_stiffness;
        for (std::size_t i = 0; i < state.nodes.size(); ++i)
            d_pressure(j, state.nodes[i]) += cell * state.tangent[static_cast<Index>(i)];
    }
    SmoothArea smooth;
    if (with_area) smooth = smooth_area(profile, body, curve);
    for (Index j = 0; j < smooth.fraction.size(); ++j)
        smooth.by_height.row(j) += smooth.by_displacement[j] * share(j) * d_last;
    return {response_of(curve.steps, curve.solver, range, full_contact_stiffness(profile, body, options.threads)),
            {std::move(d_pressure), std::move(d_last), std::move(smooth.by_height)},
            std::move(smooth.fraction)};
}

Response scaled(Response response, double factor) {
    if (response.held_nodes > 0)
        refuse("amplitude: ", response.held_nodes, " nodes are at the hardness, which does not scale by ", factor,
               "; use a response in elastic contact");
    response.range *= factor;
    response.displacement *= factor;
    response.pressure *= factor;
    if (!response.displacement.allFinite() || !response.pressure.allFinite())
        refuse("amplitude: pressures or displacements times ", factor, " exceed double precision; use another factor");
    return response;
}

std::string field_text(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    return digits;
}

NamedValues named_values(const Model& model) {
    const Body& body = model.body;
    NamedValues all{{"nodes", std::to_string(model.grid.nodes)},
                    {"length_mm", field_text(model.grid.length)},
                    {"kernel", name_of(body.kernel)},
                    {"effective_modulus_MPa", field_text(body.effective_modulus)},
                    {"steps", std::to_string(model.loading.steps)},
                    {"reach", field_text(model.loading.reach.value())}};
    if (model.grid.is_2d()) {
        all.emplace_back("rows", std::to_string(model.grid.rows));
        all.emplace_back("width_mm", field_text(model.grid.width));
    }
    if (body.kernel == Kernel::free && !model.grid.is_2d())
        all.emplace_back("datum_mm", field_text(body.datum.value()));
    if (body.kernel == Kernel::strip) all.emplace_back("strip_width_mm", field_text(body.strip_width.value()));
    if (!body.layering.layers.empty()) {
        std::string layers;
        for (const Layer& layer : body.layering.layers)
            layers += field_text(layer.thickness) + ":" + field_text(layer.modulus) + ":" +
                      field_text(layer.poissons_ratio) + " ";
        all.emplace_back("layers", layers + (body.layering.rigid_base ? "rigid" : "elastic"));
    }
    return all;
}

} // namespace rough
