#include "domain/response/response.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/choice.hpp"
#include "domain/errors.hpp"
#include "domain/response/smooth_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace rough {

Response response_of(const std::vector<LoadStep>& steps, Solver solver, double range, double full_stiffness) {
    const auto count = static_cast<Index>(steps.size());
    Response response{
        range, {}, {}, {}, {}, {}, solver, full_stiffness, steps.empty() ? 0 : steps.back().held_nodes};
    for (auto* column : {&response.displacement, &response.pressure, &response.contact_fraction,
                         &response.tangent_stiffness, &response.kkt_residual})
        column->resize(count);
    for (Index j = 0; j < count; ++j) {
        const LoadStep& step = steps[static_cast<std::size_t>(j)];
        response.displacement[j] = step.displacement;
        response.pressure[j] = step.pressure;
        response.contact_fraction[j] = step.contact_fraction;
        response.tangent_stiffness[j] = step.tangent_stiffness;
        response.kkt_residual[j] = step.kkt_residual;
    }
    return response;
}

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

namespace {

std::vector<double> even_steps(double last, const Loading& loading) {
    std::vector<double> displacements;
    for (int j = 1; j <= loading.steps; ++j)
        displacements.push_back(last * (static_cast<double>(j) / loading.steps));
    return displacements;
}

Body completed_for(const Profile& profile, const Body& body) {
    return completed(body, profile_length(profile, body.kernel));
}

/// Where to start looking for a pressure: the answer for every fourth node, whose contact is found in a
/// fraction of the time; half the range where there are too few.
double first_guess(const Profile& profile, const Body& body, double pressure, const ContactOptions& options,
                   double range) {
    constexpr Index part = 4, fewest = 256;
    const bool wraps = body.kernel == Kernel::periodic;
    if (profile.nodes() < fewest || (wraps && profile.nodes() % part != 0))
        return 0.5 * range;
    Profile coarse{Eigen::VectorXd((profile.nodes() + part - 1) / part), part * profile.spacing};
    for (Index i = 0; i < coarse.nodes(); ++i)
        coarse.heights[i] = profile.heights[part * i];
    if (!(coarse.heights.maxCoeff() > coarse.heights.minCoeff()))
        return 0.5 * range;
    try {
        return displacement_at_pressure(coarse, body, pressure, options) + profile.heights.maxCoeff() -
               coarse.heights.maxCoeff();
    } catch (const InputError&) { // its heights fill before those of all nodes do
        return range;
    }
}

} // namespace

Loading completed(Loading loading, Kernel kernel) {
    if (loading.reach == 0)
        loading.reach = kernel == Kernel::periodic ? 0.95 : 1;
    return loading;
}

void validate(const Loading& loading, Kernel kernel) {
    if (loading.steps < 2)
        refuse_value("steps", loading.steps, " given, expected at least 2");
    const bool periodic = kernel == Kernel::periodic;
    if (!(loading.reach > 0) || loading.reach > 1 || (periodic && loading.reach == 1))
        refuse_value("reach", loading.reach, " given, expected more than 0 and ",
                     periodic ? "less than 1: the periodic half-plane has no solution beyond full contact"
                              : "at most 1");
}

std::vector<double> load_displacements(double range, const Loading& given, Kernel kernel) {
    const Loading loading = completed(given, kernel);
    validate(loading, kernel);
    return even_steps(loading.reach * range, loading);
}

std::vector<double> step_displacements(const Profile& profile, const Body& body, const Loading& loading,
                                       const ContactOptions& options) {
    if (!loading.pressures.empty()) {
        std::vector<double> displacements;
        if (profile.is_2d()) {
            for (const LoadStep& step :
                 solve_contact_at_pressures(profile, body, loading.pressures, options).steps)
                displacements.push_back(step.displacement);
            return displacements;
        }
        double before = 0;
        for (const double pressure : loading.pressures) {
            if (!std::isfinite(pressure) || !(pressure > before))
                refuse("pressures: ", pressure, " MPa given after ", before,
                       " MPa, expected positive increasing finite values");
            displacements.push_back(displacement_at_pressure(profile, body, pressure, options));
            before = pressure;
        }
        return displacements;
    }
    validate(completed(loading, body.kernel), body.kernel);
    if (loading.to_displacement > 0)
        return even_steps(loading.to_displacement, loading);
    if (loading.to_pressure > 0)
        return even_steps(displacement_at_pressure(profile, body, loading.to_pressure, options), loading);
    return load_displacements(displacement_range(profile, body.kernel), loading, body.kernel);
}

double displacement_at_pressure(const Profile& profile, const Body& given, double pressure,
                                const ContactOptions& options) {
    const Body body = completed_for(profile, given);
    const double range = displacement_range(profile, body.kernel);
    // With a hardness P is not convex; on an area a solution costs too much to begin again at each guess.
    if (body.yields() || profile.is_2d())
        return solve_contact_at_pressures(profile, body, {pressure}, options).steps.front().displacement;
    const bool periodic = body.kernel == Kernel::periodic;
    const double farthest = periodic ? range * (1 - 1e-9) : std::numeric_limits<double>::infinity();
    // An iterative solver's pressures are good to its tolerance: aim so far above that none ends below.
    const bool direct = options.solver == Solver::nested || options.solver == Solver::nnls ||
                        (options.solver == Solver::automatic && profile.nodes() <= always_nested);
    const double slack = direct ? 0 : 2 * options.tolerance;
    const double aim = pressure * (1 + slack), enough = std::max(1e-12, slack / 4) * pressure;
    double displacement = std::min(farthest, first_guess(profile, body, pressure, options, range));
    for (int round = 0; round < 100; ++round) {
        const LoadStep step = solve_contact(profile, body, {displacement}, options).steps.front();
        const double missing = aim - step.pressure;
        if (std::abs(missing) <= enough)
            return displacement;
        if (missing > 0 && displacement == farthest)
            refuse("profile: in full contact at ", step.pressure, " MPa, expected at ", pressure,
                   " MPa or more: its heights are too small for the load");
        // The tangent lies below the convex curve: from a pressure too high Newton comes down without
        // passing the root; from one too low it passes it once.
        const double next = displacement + missing / step.tangent_stiffness;
        displacement = next > 0 ? std::min(next, farthest) : 0.5 * displacement;
    }
    throw NotConverged("displacement at a given pressure: not settled in 100 rounds");
}

Response respond(const Profile& profile, const Body& body, const Loading& loading,
                 const ContactOptions& options) {
    const double range = displacement_range(profile, body.kernel);
    const ContactCurve curve =
        solve_contact(profile, body, step_displacements(profile, body, loading, options), options);
    return response_of(curve.steps, curve.solver, range, full_contact_stiffness(profile, body));
}

ResponseWithGradient respond_with_gradient(const Profile& profile, const Body& body, const Loading& given,
                                           ContactOptions options, bool with_area) {
    const Loading loading = completed(given, body.kernel);
    if (!loading.pressures.empty())
        refuse("pressures: given, expected load steps of equal displacements: these have no gradient");
    if (with_area && body.yields())
        refuse("hardness: ", body.hardness,
               " MPa given, expected none: a contact fraction with held nodes has "
               "no gradient");
    const double range = displacement_range(profile, body.kernel);
    const std::vector<double> displacements = step_displacements(profile, body, loading, options);
    options.states = true;
    const ContactCurve curve = solve_contact(profile, body, displacements, options);
    const Index nodes = profile.nodes(), steps = static_cast<Index>(curve.steps.size());
    Index highest = 0, lowest = 0;
    profile.heights.maxCoeff(&highest);
    profile.heights.minCoeff(&lowest);

    // The functional Delta_last. By pressure: 0 = w.dZ - sum(w) dZ_max + sum(w) dDelta at the last step. By
    // reach: +reach at the first highest node, -reach at the first lowest (periodic: -reach/N everywhere).
    Eigen::RowVectorXd d_last = Eigen::RowVectorXd::Zero(nodes);
    if (!(loading.to_displacement > 0)) {
        if (loading.to_pressure > 0) {
            const ContactState& state = curve.states.back();
            for (std::size_t i = 0; i < state.nodes.size(); ++i)
                d_last[state.nodes[i]] -= state.tangent[static_cast<Index>(i)] / state.tangent.sum();
            d_last[highest] += 1;
        } else {
            if (body.kernel == Kernel::periodic)
                d_last.setConstant(-loading.reach / static_cast<double>(nodes));
            else
                d_last[lowest] -= loading.reach;
            d_last[highest] += loading.reach;
        }
    }

    // dP_j = (delta/L) [ w.dZ - sum(w) dZ_max + sum(w) (j/n) dDelta_last ], where (delta/L) sum(w) is the
    // tangent stiffness.
    Eigen::MatrixXd d_pressure = Eigen::MatrixXd::Zero(steps, nodes);
    for (Index j = 0; j < steps; ++j) {
        const ContactState& state = curve.states[static_cast<std::size_t>(j)];
        const LoadStep& step = curve.steps[static_cast<std::size_t>(j)];
        if (step.tangent_stiffness == 0) // every node is held
            continue;
        const double cell = step.tangent_stiffness / state.tangent.sum(); // delta/L
        d_pressure.row(j) = step.tangent_stiffness * (static_cast<double>(j + 1) / loading.steps) * d_last;
        d_pressure(j, highest) -= step.tangent_stiffness;
        for (std::size_t i = 0; i < state.nodes.size(); ++i)
            d_pressure(j, state.nodes[i]) += cell * state.tangent[static_cast<Index>(i)];
    }
    AreaGradient area;
    if (with_area) {
        SmoothArea smooth = smooth_area(profile, body, curve);
        for (Index j = 0; j < steps; ++j)
            smooth.by_height.row(j) +=
                smooth.by_displacement[j] * (static_cast<double>(j + 1) / loading.steps) * d_last;
        area = {std::move(smooth.fraction), std::move(smooth.by_height)};
    }
    return {response_of(curve.steps, curve.solver, range, full_contact_stiffness(profile, body)),
            {std::move(d_pressure), std::move(d_last)},
            std::move(area)};
}

Response scaled(Response response, double factor) {
    if (response.held_nodes > 0)
        refuse("amplitude: a response with ", response.held_nodes, " nodes at the hardness multiplied by ",
               factor, ", expected none: the hardness does not scale");
    response.range *= factor;
    response.displacement *= factor;
    response.pressure *= factor;
    if (!response.displacement.allFinite() || !response.pressure.allFinite())
        refuse("amplitude: a profile and its response multiplied by ", factor,
               ", expected a factor whose pressures and displacements fit double precision");
    return response;
}

} // namespace rough
