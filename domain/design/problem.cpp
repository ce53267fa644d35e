#include "domain/design/problem.hpp"

#include "domain/design/starts.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/cross.hpp"
#include "domain/response/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

namespace rough {

namespace {

constexpr Index judged_refinement = 4;
/// Refinement aims this far inside the limits on shape, so that it need not end on their edge.
constexpr double limit_guard = 2e-3;
/// A limit's excess in units of misfit.
constexpr double limit_weight = 3;

/// How the goals are loaded: one loading for those against pressure, one for those against displacement, or
/// one for all under Eq. 11.
struct Loadings {
    std::vector<Loading> each;
    std::vector<std::size_t> of_goal;
};

Loadings loadings_of(const DesignSetup& setup, const Loading& loading) {
    Loadings result;
    if (setup.max_pressure)
        return {{loading}, std::vector<std::size_t>(setup.goals.size(), 0)};
    double pressure = 0, displacement = 0;
    for (const Goal& goal : setup.goals)
        (goal.against_pressure() ? pressure : displacement) =
            std::max(goal.against_pressure() ? pressure : displacement, goal.last());
    for (const auto& [to_pressure, to_displacement] :
         {std::pair(pressure, 0.0), std::pair(0.0, displacement)})
        if (to_pressure + to_displacement > 0) {
            Loading one = loading;
            one.to_pressure = to_pressure;
            one.to_displacement = to_displacement;
            result.each.push_back(one);
        }
    for (const Goal& goal : setup.goals)
        result.of_goal.push_back(goal.against_pressure() ? 0 : result.each.size() - 1);
    return result;
}

Genome at_scale_one(Genome genome, const DesignSetup& setup) {
    if (setup.max_pressure)
        genome.scale = 1; // the shape alone decides, so equal keys give equal bits
    return genome;
}

/// The factor of Eq. 11.
double eq_11(const DesignSetup& setup, const Response& response) {
    return setup.max_pressure ? *setup.max_pressure / response.pressure[response.steps() - 1] : 1;
}

/// d(P', Delta'_last)/dgene of the response times p_max/P_nt: the factor moves with the genes, too.
ResponseJacobian scaled_jacobian(const Response& response, const ResponseJacobian& jacobian, double factor,
                                 const Eigen::RowVectorXd& d_factor) {
    const Index last = response.steps() - 1;
    return {factor * jacobian.pressure + response.pressure * d_factor,
            factor * jacobian.last_displacement + response.displacement[last] * d_factor};
}

CurveJacobian curve_jacobian(Quantity quantity, const Response& response, const ResponseJacobian& jacobian) {
    if (quantity == Quantity::stiffness)
        return secant_jacobian(response, jacobian);
    const Index steps = response.steps(), genes = jacobian.pressure.cols();
    CurveJacobian result{Eigen::MatrixXd::Zero(steps + 1, genes), Eigen::MatrixXd::Zero(steps + 1, genes)};
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
ga::Sensitivity goal_rows(const Goal& goal, const Response& response, const ResponseJacobian& jacobian) {
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

ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below) {
    ga::Sensitivity both{
        Eigen::VectorXd(above.residuals.size() + below.residuals.size()),
        Eigen::MatrixXd(above.jacobian.rows() + below.jacobian.rows(), above.jacobian.cols())};
    both.residuals << above.residuals, below.residuals;
    both.jacobian << above.jacobian, below.jacobian;
    return both;
}

/// All goals' rows of a genome under a model, goal after goal; and the factor of Eq. 11.
struct Rows {
    ga::Sensitivity goals;
    double factor = 1;
    Eigen::RowVectorXd d_factor; ///< in every gene; empty without Eq. 11
};

Rows all_rows(const DesignSetup& setup, const Genome& genome, const Model& model) {
    const Loadings loadings = loadings_of(setup, model.loading);
    const Profile profile = sample(genome, model.grid);
    Rows result;
    std::vector<Response> responses;
    std::vector<ResponseJacobian> jacobians;
    for (const Loading& loading : loadings.each) {
        auto [response, gradient] = respond_with_gradient(profile, model.body, loading, model.contact);
        ResponseJacobian jacobian = in_genes(
            gradient, [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); });
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
        const ga::Sensitivity rows = goal_rows(setup.goals[g], responses[of], jacobians[of]);
        result.goals = g == 0 ? rows : stacked(result.goals, rows);
    }
    return result;
}

/// The responses to all ways of loading, each asked of `respond_to`, in final amplitude.
template <class Respond>
DesignResponse loaded(const DesignSetup& setup, const Model& model, Respond respond_to) {
    const Loadings loadings = loadings_of(setup, model.loading);
    DesignResponse result{1, {}, loadings.of_goal};
    for (const Loading& loading : loadings.each) {
        Response response = respond_to(loading);
        result.scale = eq_11(setup, response);
        result.responses.push_back(setup.max_pressure ? scaled(std::move(response), result.scale)
                                                      : std::move(response));
    }
    return result;
}

std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response) {
    std::vector<Eigen::VectorXd> misfits;
    for (std::size_t g = 0; g < setup.goals.size(); ++g)
        misfits.push_back(misfit(setup.goals[g],
                                 curve_of(setup.goals[g].quantity, response.responses[response.of_goal[g]])));
    return misfits;
}

/// Points of the first goal in the lower or upper half of its range.
std::vector<Index> half_of(const Goal& goal, bool upper) {
    std::vector<Index> points;
    for (Index k = 0; k < goal.points(); ++k)
        if (upper ? goal.x[k] >= 0.5 * goal.last() : goal.x[k] <= 0.5 * goal.last())
            points.push_back(k);
    return points;
}

void check(const DesignSetup& setup) {
    if (setup.goals.empty())
        throw InputError("target: none given, expected at least one");
    for (const Goal& goal : setup.goals) {
        validate(goal);
        if (!(goal.weight > 0) || goal.weight > 1)
            throw InputError(goal.name + ": weight " + std::to_string(goal.weight) +
                             " given, expected more than 0, at most 1");
        if (setup.max_pressure && goal.against_pressure() && goal.last() > *setup.max_pressure * (1 + 1e-9)) {
            std::ostringstream line;
            line << goal.name << ": pressures up to " << goal.last() << " MPa given, expected at most "
                 << "max-pressure, " << *setup.max_pressure << " MPa";
            throw InputError(line.str());
        }
        if (setup.max_pressure && !goal.against_pressure())
            throw InputError(goal.name +
                             ": a curve against displacement was given with max-pressure, expected "
                             "one of the two: Eq. 11 fixes no displacement");
    }
}

} // namespace

double DesignOutcome::similarity() const {
    double worst = 0;
    for (const Eigen::VectorXd& misfit : misfits)
        worst = std::max(worst, misfit.cwiseAbs().maxCoeff());
    return 1 - worst;
}

DesignProblem::DesignProblem(DesignSetup setup)
    : DesignProblem(std::make_shared<DesignSetup>(std::move(setup))) {}

DesignProblem::DesignProblem(std::shared_ptr<DesignSetup> setup) : setup_(setup) {
    check(*setup);
    // Below every genome within the limits, by how far it is over them.
    const auto limited = [](double similarity, const Outcome& outcome) {
        return outcome.excess > 0 ? std::min(similarity, 0.0) - 1 - outcome.excess : similarity;
    };
    const auto part = [limited, this](bool upper) {
        return [limited, points = half_of(setup_->goals.front(), upper)](const Outcome& outcome) {
            double worst = 0;
            for (const Index k : points)
                worst = std::max(worst, std::abs(outcome.misfits.front()[k]));
            return limited(1 - worst, outcome);
        };
    };
    objectives_ = {
        {"similarity", [=](const Outcome& outcome) { return limited(outcome.similarity(), outcome); }},
        {"judged",
         [=, setup = setup_](const Outcome& outcome) {
             return limited(
                 std::min(outcome.similarity(), rough::similarity(*setup, outcome.genome, judged_refinement)),
                 outcome);
         }},
        {"low", part(false)},
        {"high", part(true)}};
}

DesignOutcome DesignProblem::evaluate(const Genome& genome) const {
    const DesignResponse response = respond(*setup_, genome, setup_->model);
    Outcome outcome{response.scale, misfits_of(*setup_, response), 0, genome};
    if (setup_->max_pressure)
        outcome.genome.scale = response.scale;
    outcome.excess = excess(outcome.genome, setup_->model.grid, setup_->limits);
    return outcome;
}

std::string DesignProblem::key(const Genome& genome) const {
    return shape_key(setup_->max_pressure ? genome : folded(genome));
}

Genome DesignProblem::settled(Genome genome, const Outcome& outcome) const {
    if (setup_->max_pressure)
        genome.scale = outcome.scale;
    return genome;
}

Genome DesignProblem::sample(ga::Stream& random) const {
    return with_fitting_amplitude(*setup_, drawn_start(*setup_, ga::Stream(random())));
}

void DesignProblem::cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) const {
    rough::cross_points(a, b, cuts, stream);
}

void DesignProblem::cross_uniform(Genome& a, Genome& b, ga::Stream& stream) const {
    rough::cross_uniform(a, b, stream);
}

std::vector<ga::Variable> DesignProblem::bounds(const Genome& genome) const {
    const GeneBounds& within = setup_->bounds;
    const auto places = gene_places(genome);
    const auto values = genes(genome);
    std::vector<ga::Variable> variables;
    for (std::size_t g = 0; g < places.size(); ++g) {
        const Series& series = genome.series[places[g].series];
        int last = 1;
        for (const Chromosome& chromosome : series.chromosomes)
            last = std::max(last, chromosome.n);
        const double slack =
            setup_->limits.shortest_wave > 0
                ? std::max(0.0, std::log(wave_length(series, last) / setup_->limits.shortest_wave))
                : 10;
        double from = 0, to = 0;
        switch (places[g].kind) {
        case GenePlace::Kind::A:
            from = std::min(0.1 * values[g], 10 * values[g]);
            to = std::max(0.1 * values[g], 10 * values[g]);
            break;
        case GenePlace::Kind::H:
            from = within.H_from, to = within.H_to;
            break;
        case GenePlace::Kind::gamma:
            from = within.gamma_from;
            to = last > 1 ? std::min(within.gamma_to, values[g] * std::exp(0.5 * slack / (last - 1)))
                          : within.gamma_to;
            break;
        case GenePlace::Kind::lambda:
            from = std::max(within.lambda_from, values[g] * std::exp(-0.5 * slack));
            to = within.lambda_to;
            break;
        case GenePlace::Kind::phase:
            from = values[g] - std::numbers::pi;
            to = values[g] + std::numbers::pi;
            break;
        }
        if (from <= values[g] && values[g] <= to)
            variables.push_back({g, from, to});
    }
    return variables;
}

ga::Sensitivity DesignProblem::sensitivity(const Genome& genome, const std::string& objective) const {
    Genome shape = at_scale_one(genome, *setup_);
    const Rows coarse = all_rows(*setup_, shape, setup_->model);
    ga::Sensitivity rows = coarse.goals;
    if (objective == "judged")
        rows = stacked(rows, all_rows(*setup_, shape, refined(setup_->model, judged_refinement)).goals);
    if (objective == "low" || objective == "high") {
        const std::vector<Index> points = half_of(setup_->goals.front(), objective == "high");
        rows = {Eigen::VectorXd(rows.residuals(points)), Eigen::MatrixXd(rows.jacobian(points, Eigen::all))};
    }
    if (setup_->limits.any_shape()) {
        if (setup_->max_pressure)
            shape.scale = coarse.factor;
        const LimitRows limits =
            limit_rows(shape, setup_->model.grid, setup_->limits, limit_guard, coarse.d_factor);
        rows = stacked(rows, {limit_weight * limits.residuals, limit_weight * limits.jacobian});
    }
    return rows;
}

DesignResponse respond(const DesignSetup& setup, const Profile& profile, const Model& model) {
    return loaded(setup, model, [&](const Loading& loading) {
        return respond(profile, model.body, loading, model.contact);
    });
}

DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model) {
    const Genome shape = at_scale_one(genome, setup);
    if (model.accuracy == 0)
        return respond(setup, sample(shape, model.grid), model);
    return loaded(setup, model, [&](const Loading& loading) {
        Model one = model;
        one.loading = loading;
        return respond(shape, one);
    });
}

std::vector<Model> loaded_models(const DesignSetup& setup) {
    std::vector<Model> models;
    for (const Loading& loading : loadings_of(setup, setup.model.loading).each) {
        models.push_back(setup.model);
        models.back().loading = loading;
    }
    return models;
}

DesignSetup exactly(DesignSetup setup) {
    setup.model = exactly(std::move(setup.model));
    return setup;
}

double similarity(const DesignSetup& setup, const DesignResponse& response) {
    double worst = 0;
    for (const Eigen::VectorXd& misfit : misfits_of(setup, response))
        worst = std::max(worst, misfit.cwiseAbs().maxCoeff());
    return 1 - worst;
}

double similarity(const DesignSetup& setup, const Genome& genome, Index refine) {
    return similarity(setup, respond(setup, genome, refined(setup.model, refine)));
}

} // namespace rough
