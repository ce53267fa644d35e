#include "domain/fitness/rescaled_problem.hpp"

#include "domain/errors.hpp"
#include "domain/response/sensitivity.hpp"

#include <numeric>
#include <sstream>

namespace rough {

namespace {

RescaledResponse rescaled(Response response, double max_pressure) {
    const double scale = max_pressure / response.pressure[response.steps() - 1]; // Eq. 11
    Curve stiffness = stretched(secant_stiffness(response), scale);
    return {scale, std::move(stiffness), std::move(response)};
}

/// The shape alone decides, so equal keys give equal bits.
Genome at_scale_one(Genome genome) {
    genome.scale = 1;
    return genome;
}

} // namespace

RescaledProblem::RescaledProblem(Model model, Target target, double max_pressure, double threshold,
                                 std::shared_ptr<ResponseMemory> memory, PhaseReach reach)
    : model_(std::move(model)), target_(std::move(target)), max_pressure_(max_pressure),
      memory_(std::move(memory)), reach_(reach) {
    validate(target_);
    if (!(max_pressure > 0) || target_.highest_pressure() > max_pressure * (1 + 1e-9)) {
        std::ostringstream line;
        line << target_.name << ": pressures up to " << target_.highest_pressure()
             << " MPa given, expected at most max-pressure, " << max_pressure << " MPa";
        throw InputError(line.str());
    }
    std::vector<Index> all(static_cast<std::size_t>(target_.points()));
    std::iota(all.begin(), all.end(), Index{0});
    points_ = {{"similarity", all},
               {"low", points_within(target_, {0, threshold})},
               {"high", points_within(target_, {threshold, max_pressure * (1 + 1e-9)})}};
    for (const auto& [name, points] : points_) {
        if (points.empty()) {
            std::ostringstream line;
            line << "threshold: " << threshold << " MPa leaves no point of the target " << target_.name
                 << " in the " << name << " part, expected one within its pressures";
            throw InputError(line.str());
        }
        objectives_.push_back({name, [target = target_, points = points](const Outcome& outcome) {
                                   return similarity(target, outcome.stiffness, points);
                               }});
    }
}

const std::vector<Index>& RescaledProblem::points_of(const std::string& objective) const {
    for (const auto& [name, points] : points_)
        if (name == objective)
            return points;
    throw InputError("objective: \"" + objective + "\" given, expected similarity, low or high");
}

RescaledResponse RescaledProblem::evaluate(const Genome& genome) const {
    if (!memory_)
        return rescaled(respond(at_scale_one(genome), model_), max_pressure_);
    const std::string shape = shape_key(genome);
    std::optional<Response> response = memory_->find(shape);
    if (!response) {
        response = respond(at_scale_one(genome), model_);
        memory_->keep(shape, *response);
    }
    return rescaled(std::move(*response), max_pressure_);
}

Genome RescaledProblem::settled(Genome genome, const Outcome& outcome) const {
    genome.scale = outcome.scale;
    return genome;
}

ga::Sensitivity RescaledProblem::sensitivity(const Genome& genome, const std::string& objective) const {
    const Genome shape = at_scale_one(genome);
    const auto [response, gradient, area] =
        respond_with_gradient(sample(shape, model_.grid), model_.body, model_.loading, model_.contact);
    const ResponseJacobian jacobian = in_genes(
        gradient, [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, shape, model_.grid); });

    const auto& points = points_of(objective);
    const Curve curve = rescaled(response, max_pressure_).stiffness;
    return {relative_misfit(target_, curve, points),
            misfit_jacobian(target_, curve, rescaled_jacobian(response, jacobian, max_pressure_), points)};
}

double similarity(const RescaledProblem& problem, const Genome& genome, Index refine) {
    return similarity(problem.target(),
                      rescaled(respond(at_scale_one(genome), exactly(refined(problem.model(), refine))),
                               problem.max_pressure())
                          .stiffness);
}

Genome in_final_form(const RescaledProblem& problem, Genome genome) {
    genome = at_scale_one(std::move(genome));
    genome.scale = rescaled(respond(genome, exactly(problem.model())), problem.max_pressure()).scale;
    return genome;
}

} // namespace rough
