#include "domain/problem/rows.hpp"

#include "domain/mwm/sampling.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/target.hpp"

namespace rough {

namespace {

CurveJacobian curve_jacobian(Quantity quantity, const Response& response, const ResponseJacobian& jacobian) {
    if (quantity == Quantity::stiffness)
        return secant_jacobian(response, jacobian);
    if (quantity == Quantity::interface_stiffness)
        return interface_jacobian(secant_jacobian(response, jacobian), secant_stiffness(response),
                                  response.full_stiffness);
    const Index steps = response.steps(), genes = jacobian.pressure.cols();
    CurveJacobian result{Eigen::MatrixXd::Zero(steps + 1, genes), Eigen::MatrixXd::Zero(steps + 1, genes)};
    if (is_contact_fraction(quantity))
        result.y.bottomRows(steps) = jacobian.contact_fraction;
    if (quantity == Quantity::area_at_pressure) {
        result.x.bottomRows(steps) = jacobian.pressure;
        return result;
    }
    for (Index j = 0; j < steps; ++j)
        result.x.row(j + 1) =
            static_cast<double>(j + 1) / static_cast<double>(steps) * jacobian.last_displacement;
    if (quantity == Quantity::load_at_displacement)
        result.y.bottomRows(steps) = jacobian.pressure;
    return result;
}

/// The response to each loading, and its derivatives in genes.
struct Pressed {
    std::vector<Response> responses;
    std::vector<ResponseJacobian> jacobians;
};

using Pull = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

Pressed pressed_with_jacobian(const DesignSetup& setup, const Profile& profile, const Loadings& loadings,
                              const Model& model, const Pull& pull) {
    Pressed result;
    for (std::size_t l = 0; l < loadings.each.size(); ++l) {
        bool with_area = false;
        for (std::size_t t = 0; t < setup.targets.size(); ++t)
            with_area |= loadings.of_target[t] == l && is_contact_fraction(setup.targets[t].quantity);
        auto [response, gradient, area] =
            respond_with_gradient(profile, model.body, up_to_full_contact(loadings.each[l], profile, model),
                                  model.contact, with_area);
        result.jacobians.push_back(in_genes(gradient, pull, area));
        if (with_area)
            response.contact_fraction = area.fraction;
        result.responses.push_back(std::move(response));
    }
    return result;
}

Pressed pressed_with_jacobian(const DesignSetup& setup, const Genome& genome, const Model& model) {
    return pressed_with_jacobian(
        setup, sample(genome, model.grid), loadings_of(setup, model.loading), model,
        [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); });
}

Rows rows_of(const DesignSetup& setup, const Pressed& pressed) {
    const Loadings loadings = loadings_of(setup, setup.model.loading);
    const auto& [responses, jacobians] = pressed;
    Rows result;
    if (setup.max_pressure) {
        const Index last = responses[0].steps() - 1;
        result.factor = eq_11(setup, responses[0]);
        result.d_factor = -result.factor / responses[0].pressure[last] * jacobians[0].pressure.row(last);
    }
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        const Target& target = setup.targets[t];
        const std::size_t l = loadings.of_target[t];
        Curve curve = curve_of(target.quantity, responses[l]);
        CurveJacobian jacobian = curve_jacobian(target.quantity, responses[l], jacobians[l]);
        if (setup.max_pressure) { // the factor depends on the genes, too
            jacobian.x = result.factor * jacobian.x + curve.x * result.d_factor;
            curve = stretched(std::move(curve), result.factor);
        }
        continue_beyond_full_contact(setup, target, curve, &jacobian);
        const Eigen::VectorXd misfits = misfit(target, curve);
        const ga::Sensitivity rows{misfits, misfit_jacobian(target, curve, jacobian, misfits)};
        result.misfits = t == 0 ? rows : stacked(result.misfits, rows);
    }
    return result;
}

Pressed every(Index part, Pressed pressed) {
    for (Response& response : pressed.responses)
        response = every(part, std::move(response));
    for (ResponseJacobian& jacobian : pressed.jacobians)
        for (auto* rows : {&jacobian.pressure, &jacobian.contact_fraction})
            *rows = Eigen::MatrixXd((*rows)(Eigen::seqN(part - 1, rows->rows() / part, part), Eigen::all));
    return pressed;
}

} // namespace

Response every(Index part, Response response) {
    const Index steps = response.steps() / part;
    for (auto* column : {&response.displacement, &response.pressure, &response.contact_fraction,
                         &response.tangent_stiffness, &response.kkt_residual})
        *column = Eigen::VectorXd((*column)(Eigen::seqN(part - 1, steps, part)));
    return response;
}

ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below) {
    ga::Sensitivity both{
        Eigen::VectorXd(above.residuals.size() + below.residuals.size()),
        Eigen::MatrixXd(above.jacobian.rows() + below.jacobian.rows(), above.jacobian.cols())};
    both.residuals << above.residuals, below.residuals;
    both.jacobian << above.jacobian, below.jacobian;
    return both;
}

Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model) {
    return rows_of(setup, pressed_with_jacobian(setup, genome, model));
}

Rows misfit_rows(const DesignSetup& setup, const Profile& profile, const Loadings& loadings,
                 const Model& model, const Pull& in_genes) {
    return rows_of(setup, pressed_with_jacobian(setup, profile, loadings, model, in_genes));
}

std::array<Rows, 2> stepped_rows(const DesignSetup& setup, const DesignSetup& finer, const Genome& genome,
                                 Index refine) {
    Pressed fine = pressed_with_jacobian(finer, genome, refined(finer.model, refine));
    Rows all = rows_of(finer, fine);
    return {std::move(all), rows_of(setup, every(verified_refinement, std::move(fine)))};
}

} // namespace rough
