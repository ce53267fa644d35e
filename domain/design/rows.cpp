#include "domain/design/rows.hpp"

#include "domain/design/loadings.hpp"
#include "domain/response/sensitivity.hpp"

#include <numeric>

namespace rough {

namespace {

/// d(P', Delta'_last)/dgene of the response times p_max/P_nt: the factor moves with the genes, too.
ResponseJacobian scaled_jacobian(const Response& response, const ResponseJacobian& jacobian, double factor,
                                 const Eigen::RowVectorXd& d_factor) {
    const Index last = response.steps() - 1;
    return {factor * jacobian.pressure + response.pressure * d_factor,
            factor * jacobian.last_displacement + response.displacement[last] * d_factor,
            jacobian.contact_fraction};
}

CurveJacobian curve_jacobian(Quantity quantity, const Response& response, const ResponseJacobian& jacobian) {
    if (quantity == Quantity::stiffness)
        return secant_jacobian(response, jacobian);
    const Index steps = response.steps(), genes = jacobian.pressure.cols();
    CurveJacobian result{Eigen::MatrixXd::Zero(steps + 1, genes), Eigen::MatrixXd::Zero(steps + 1, genes)};
    if (is_area(quantity))
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

/// Misfits of one goal with their derivatives, rows the goal's points.
ga::Sensitivity rows_of(const Goal& goal, const Response& response, const ResponseJacobian& jacobian) {
    const Curve curve = curve_of(goal.quantity, response);
    Target points{goal.name, goal.x, goal.y};
    std::vector<Index> all(static_cast<std::size_t>(goal.points()));
    std::iota(all.begin(), all.end(), Index{0});
    ga::Sensitivity rows{
        misfit(goal, curve),
        goal.weight * misfit_jacobian(points, curve, curve_jacobian(goal.quantity, response, jacobian), all)};
    if (goal.has_band())
        for (Index k = 0; k < goal.points(); ++k)
            if (rows.residuals[k] == 0)
                rows.jacobian.row(k).setZero();
    return rows;
}

} // namespace

ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below) {
    ga::Sensitivity both{
        Eigen::VectorXd(above.residuals.size() + below.residuals.size()),
        Eigen::MatrixXd(above.jacobian.rows() + below.jacobian.rows(), above.jacobian.cols())};
    both.residuals << above.residuals, below.residuals;
    both.jacobian << above.jacobian, below.jacobian;
    return both;
}

Rows goal_rows(const DesignSetup& setup, const Genome& genome, const Model& model) {
    const Loadings loadings = loadings_of(setup, model.loading);
    const Profile profile = sample(genome, model.grid);
    Rows result;
    std::vector<Response> responses;
    std::vector<ResponseJacobian> jacobians;
    for (std::size_t way = 0; way < loadings.each.size(); ++way) {
        bool with_area = false;
        for (std::size_t g = 0; g < setup.goals.size(); ++g)
            with_area |= loadings.of_goal[g] == way && is_area(setup.goals[g].quantity);
        auto [response, gradient, area] =
            respond_with_gradient(profile, model.body, loadings.each[way], model.contact, with_area);
        ResponseJacobian jacobian = in_genes(
            gradient, [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); },
            area);
        if (with_area)
            response.contact_fraction = area.fraction;
        if (setup.max_pressure) {
            const Index last = response.steps() - 1;
            result.factor = eq_11(setup, response);
            result.d_factor = -result.factor / response.pressure[last] * jacobian.pressure.row(last);
            jacobian = scaled_jacobian(response, jacobian, result.factor, result.d_factor);
            response = scaled(std::move(response), result.factor);
        }
        responses.push_back(std::move(response));
        jacobians.push_back(std::move(jacobian));
    }
    for (std::size_t g = 0; g < setup.goals.size(); ++g) {
        const std::size_t of = loadings.of_goal[g];
        const ga::Sensitivity rows = rows_of(setup.goals[g], responses[of], jacobians[of]);
        result.goals = g == 0 ? rows : stacked(result.goals, rows);
    }
    return result;
}

} // namespace rough
