#include "domain/problem/response.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"

namespace rough {
namespace {

/// The share of the displacement of full contact at which a curve ends if it cannot be continued.
constexpr double nearly_full = 0.999;

/// A map's load is found to its solver's tolerance. With this factor, no load ends below the target.
double load_slack(const Model& model) { return model.grid.is_2d() ? 1 + 3 * model.contact.tolerance : 1; }

/// Whether a profile may reach full contact before the load steps end: on an elastic periodic body.
bool may_pass_full_contact(const Loading& loading, const Body& body) {
    return body.relative_to_mean() && !body.yields() && (loading.to_displacement || loading.to_pressure);
}

CurveJacobian curve_jacobian(Quantity quantity, const Response& response, const ResponseJacobian& jacobian) {
    if (quantity == Quantity::stiffness) return secant_jacobian(response, jacobian);
    if (quantity == Quantity::interface_stiffness)
        return interface_jacobian(secant_jacobian(response, jacobian), secant_stiffness(response),
                                  response.full_stiffness);
    const Index steps = response.steps(), genes = jacobian.pressure.cols();
    CurveJacobian result{Eigen::MatrixXd::Zero(steps + 1, genes), Eigen::MatrixXd::Zero(steps + 1, genes)};
    result.y.bottomRows(steps) = is_contact_fraction(quantity) ? jacobian.contact_fraction : jacobian.pressure;
    if (against_pressure(quantity))
        result.x.bottomRows(steps) = jacobian.pressure;
    else
        for (Index j = 0; j < steps; ++j)
            result.x.row(j + 1) =
                response.displacement[j] / response.displacement[steps - 1] * jacobian.last_displacement;
    return result;
}

/// The index of a target's loading among `count` ones.
std::size_t loading_of(const Target& target, std::size_t count) { return target.against_pressure() ? 0 : count - 1; }

/// Continues a curve that ends in full contact before its target, and its derivatives if given. Adds a point
/// at twice the last x. The contact fraction there is unchanged. Stiffness and load are 101 times the last
/// value, so that they do not match any target.
void continue_beyond_full_contact(const DesignSetup& setup, const Target& target, Curve& curve,
                                  CurveJacobian* jacobian = nullptr) {
    const Body& body = setup.model.body;
    constexpr double rounding = 1e-6; // iteration finds a load to this share
    if (setup.max_pressure || !body.relative_to_mean() || body.yields() || curve.to >= (1 - rounding) * target.last())
        return;
    const Index points = curve.x.size();
    const double rise = is_contact_fraction(target.quantity) ? 1 : 101;
    const auto append = [&](auto& rows, double factor) {
        rows.conservativeResize(points + 1, rows.cols());
        rows.row(points) = factor * rows.row(points - 1);
    };
    append(curve.x, 2);
    append(curve.y, rise);
    curve.to = target.last();
    if (jacobian) {
        append(jacobian->x, 2);
        append(jacobian->y, rise);
    }
}

} // namespace

std::vector<Loading> loadings_of(const DesignSetup& setup, const Loading& loading) {
    if (setup.max_pressure) return {loading};
    std::vector<Loading> loadings;
    for (const bool by_pressure : {true, false}) {
        double last = 0;
        for (const Target& target : setup.targets)
            if (target.against_pressure() == by_pressure) last = std::max(last, target.last());
        if (last == 0) continue;
        Loading one = loading;
        one.to_pressure.reset(), one.to_displacement.reset();
        (by_pressure ? one.to_pressure : one.to_displacement) = by_pressure ? last * load_slack(setup.model) : last;
        loadings.push_back(std::move(one));
    }
    return loadings;
}

Genome at_scale_one(Genome genome, const DesignSetup& setup) {
    if (setup.max_pressure) genome.scale = 1;
    return genome;
}

std::string key_of(const DesignSetup& setup, const Genome& genome) {
    return shape_key(setup.max_pressure ? genome : folded(genome));
}

double eq_11(const DesignSetup& setup, const Response& response) {
    if (!setup.max_pressure) return 1;
    const double last = response.pressure[response.steps() - 1], factor = *setup.max_pressure / last;
    if (!std::isfinite(factor) || !(factor > 0))
        refuse("max-pressure: ", *setup.max_pressure, " MPa over the ", last,
               " MPa that the profile carries does not fit double precision; give another pressure");
    return factor;
}

DesignResponse design_response(const DesignSetup& setup, std::vector<Response> responses) {
    DesignResponse result;
    result.scale = eq_11(setup, responses.front());
    for (const Target& target : setup.targets) {
        const Response& response = responses[loading_of(target, responses.size())];
        result.curves.push_back(stretched(curve_of(target.quantity, response), result.scale));
        continue_beyond_full_contact(setup, target, result.curves.back());
    }
    for (Response& response : responses)
        result.responses.push_back(setup.max_pressure ? scaled(std::move(response), result.scale)
                                                      : std::move(response));
    return result;
}

Loading up_to_full_contact(Loading loading, const Profile& profile, const Model& model) {
    if (!may_pass_full_contact(loading, model.body)) return loading;
    if (loading.to_displacement > nearly_full * displacement_range(profile, model.body.kernel) ||
        (loading.to_pressure && *loading.to_pressure > nearly_full * full_contact_load(profile, model.body))) {
        loading.to_displacement.reset(), loading.to_pressure.reset();
        loading.reach = nearly_full;
    }
    return loading;
}

std::vector<Response> responses_of(const DesignSetup& setup, const Genome& genome, const Model& model) {
    std::vector<Response> responses;
    const Genome shape = at_scale_one(genome, setup);
    Model loaded = model;
    for (const Loading& loading : loadings_of(setup, model.loading)) {
        loaded.loading = loading;
        if (may_pass_full_contact(loading, model.body))
            loaded.loading = up_to_full_contact(loading, sample(shape, model.grid), model);
        responses.push_back(setup.smooth_area
                                ? respond_smoothly(sample(shape, model.grid), model.body, loaded.loading, model.contact)
                                : respond(shape, loaded));
    }
    return responses;
}

DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model) {
    return design_response(setup, responses_of(setup, genome, model));
}

std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response) {
    std::vector<Eigen::VectorXd> misfits;
    for (std::size_t t = 0; t < setup.targets.size(); ++t)
        misfits.push_back(misfit(setup.targets[t], response.curves[t]));
    return misfits;
}

std::vector<double> similarities(const std::vector<Eigen::VectorXd>& misfits) {
    return column(misfits, [](const Eigen::VectorXd& each) { return similarity(each); });
}

std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response) {
    return similarities(misfits_of(setup, response));
}

double min_similarity(const std::vector<Eigen::VectorXd>& misfits) { return std::ranges::min(similarities(misfits)); }

double similarity(const DesignSetup& setup, const DesignResponse& response) {
    return min_similarity(misfits_of(setup, response));
}

double similarity(const DesignSetup& setup, const Genome& genome, Index refine) {
    return similarity(setup, respond(setup, genome, refined(setup.model, refine)));
}

Genome in_final_form(const DesignSetup& setup, Genome genome) {
    if (setup.max_pressure) genome.scale = respond(setup, genome, setup.model).scale;
    return genome;
}

ga::Sensitivity stacked(const std::vector<ga::Sensitivity>& parts) {
    Index rows = 0;
    for (const ga::Sensitivity& part : parts) rows += part.residuals.size();
    ga::Sensitivity all{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, parts.front().jacobian.cols())};
    for (Index at = 0; const ga::Sensitivity& part : parts) {
        all.residuals.segment(at, part.residuals.size()) = part.residuals;
        all.jacobian.middleRows(at, part.residuals.size()) = part.jacobian;
        at += part.residuals.size();
    }
    return all;
}

Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model) {
    return misfit_rows(setup, sample(genome, model.grid), loadings_of(setup, model.loading), model,
                       [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); });
}

Rows misfit_rows(const DesignSetup& setup, const Profile& profile, const std::vector<Loading>& loadings,
                 const Model& model, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& pull) {
    std::vector<Response> responses;
    std::vector<ResponseJacobian> jacobians;
    for (std::size_t l = 0; l < loadings.size(); ++l) {
        const bool with_area = std::ranges::any_of(setup.targets, [&](const Target& target) {
            return loading_of(target, loadings.size()) == l && is_contact_fraction(target.quantity);
        });
        auto [response, gradient, smooth_fraction] = respond_with_gradient(
            profile, model.body, up_to_full_contact(loadings[l], profile, model), model.contact, with_area);
        jacobians.push_back(in_genes(gradient, pull));
        if (with_area) response.contact_fraction = smooth_fraction;
        responses.push_back(std::move(response));
    }
    Rows result;
    if (setup.max_pressure) {
        const Index last = responses[0].steps() - 1;
        result.factor = eq_11(setup, responses[0]);
        result.d_factor = -result.factor / responses[0].pressure[last] * jacobians[0].pressure.row(last);
    }
    std::vector<ga::Sensitivity> parts;
    for (const Target& target : setup.targets) {
        const std::size_t l = loading_of(target, responses.size());
        Curve curve = curve_of(target.quantity, responses[l]);
        CurveJacobian jacobian = curve_jacobian(target.quantity, responses[l], jacobians[l]);
        if (setup.max_pressure) { // the factor depends on the genes, too
            jacobian.x = result.factor * jacobian.x + curve.x * result.d_factor;
            curve = stretched(std::move(curve), result.factor);
        }
        continue_beyond_full_contact(setup, target, curve, &jacobian);
        const Eigen::VectorXd misfits = misfit(target, curve);
        parts.push_back({misfits, misfit_jacobian(target, curve, jacobian, misfits)});
    }
    result.misfits = stacked(parts);
    return result;
}

} // namespace rough
