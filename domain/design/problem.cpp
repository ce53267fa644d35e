#include "domain/design/problem.hpp"

#include "domain/design/defaults.hpp"
#include "domain/design/loadings.hpp"
#include "domain/design/rows.hpp"
#include "domain/design/starts.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/cross.hpp"
#include "domain/target/recorded.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rough {

namespace {

constexpr Index judged_refinement = 4;
/// Refinement aims this far inside the limits on shape, so that it need not end on their edge.
constexpr double limit_guard = 2e-3;
/// A limit's excess in units of misfit.
constexpr double limit_weight = 30;

std::string goal_objective(std::size_t goal) { return "goal" + std::to_string(goal + 1); }

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
        expect_recorded(goal, setup.model);
        if (!(goal.weight > 0) || goal.weight > 1)
            refuse(goal.name, ": weight ", goal.weight, " given, expected more than 0, at most 1");
        if (setup.max_pressure && goal.against_pressure() && goal.last() > *setup.max_pressure * (1 + 1e-9))
            refuse(goal.name, ": pressures up to ", goal.last(),
                   " MPa given, expected at most max-pressure, ", *setup.max_pressure, " MPa");
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
    : DesignProblem(std::make_shared<DesignSetup>(completed(std::move(setup)))) {}

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
    for (std::size_t g = 0; g < setup_->goals.size(); ++g)
        objectives_.push_back({goal_objective(g), [=](const Outcome& outcome) {
                                   return limited(1 - outcome.misfits[g].cwiseAbs().maxCoeff(), outcome);
                               }});
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
    const Rows coarse = goal_rows(*setup_, shape, setup_->model);
    ga::Sensitivity rows = coarse.goals;
    if (objective == "judged")
        rows = stacked(rows, goal_rows(*setup_, shape, refined(setup_->model, judged_refinement)).goals);
    if (objective == "low" || objective == "high") {
        const std::vector<Index> points = half_of(setup_->goals.front(), objective == "high");
        rows = {Eigen::VectorXd(rows.residuals(points)), Eigen::MatrixXd(rows.jacobian(points, Eigen::all))};
    }
    Index first = 0;
    for (std::size_t g = 0; g < setup_->goals.size(); first += setup_->goals[g++].points())
        if (objective == goal_objective(g)) {
            const Index points = setup_->goals[g].points();
            rows = {Eigen::VectorXd(rows.residuals.segment(first, points)),
                    Eigen::MatrixXd(rows.jacobian.middleRows(first, points))};
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

} // namespace rough
