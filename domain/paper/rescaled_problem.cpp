#include "domain/paper/rescaled_problem.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/contact/stepped.hpp"
#include "domain/errors.hpp"
#include "domain/paper/foretold.hpp"
#include "domain/response/sensitivity.hpp"
#include "domain/target/similarity_bound.hpp"
#include "domain/target/stiffness_limits.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

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

/// A grid this coarse tells full contact's stiffness from above, and at once.
constexpr Index full_contact_nodes = 128;
/// Beyond so many nodes the nested factor may not fit.
constexpr Index most_appraised_nodes = 8192;

double stiffest(Model model) {
    model.grid.nodes = std::min(model.grid.nodes, full_contact_nodes);
    return stiffness_limits(model).most;
}

/// One genome's load steps as far as they are solved.
class Steps : public ga::Appraisal<RescaledResponse> {
  public:
    Steps(const RescaledProblem& problem, Genome shape, const Profile& profile,
          std::vector<SimilarityBound> bounds)
        : problem_(problem), shape_(std::move(shape)),
          range_(displacement_range(profile, problem.model().body.kernel)),
          contact_(profile, problem.model().body,
                   step_displacements(profile, problem.model().body, problem.model().loading,
                                      problem.model().contact),
                   problem.model().contact),
          foretold_(problem.outlook() == Outlook::foretold
                        ? foretold_secants(profile, problem.model(), contact_.displacements())
                        : std::vector<double>()),
          similarity_(std::move(bounds)), at_once_(std::max<std::size_t>(1, count() / 20)) {
        // Sooner than after a tenth of the steps hardly a curve can be told from another.
        while (contact_.steps().size() < std::max<std::size_t>(2, count() / 10))
            contact_.press();
    }

    double bound(std::size_t objective) override {
        auto& [bound, steps] = judged_[objective];
        if (steps != contact_.steps().size() && !contact_.done())
            bound = std::min(bound, similarity_[objective](contact_.steps(), count(), foretold_));
        steps = contact_.steps().size();
        return bound;
    }
    void advance() override {
        // A light step costs less than to come back to it once more.
        const std::size_t steps = 2 * contact_.steps().size() < count() ? 2 * at_once_ : at_once_;
        for (std::size_t i = 0; i < steps && !contact_.done(); ++i)
            contact_.press();
    }
    std::optional<RescaledResponse> outcome() override {
        if (!contact_.done())
            return std::nullopt;
        if (!contact_.is_own_choice())
            return problem_.evaluate(shape_);
        const Grid& grid = problem_.model().grid;
        return problem_.of_response(
            shape_, response_of(contact_.steps(), Solver::nested, range_,
                                full_contact_stiffness(grid.nodes, grid.spacing(), problem_.model().body)));
    }

  private:
    std::size_t count() const { return contact_.displacements().size(); }

    struct Judged {
        double bound = std::numeric_limits<double>::infinity();
        std::size_t steps = 0; ///< that were known then
    };

    const RescaledProblem& problem_;
    Genome shape_;
    double range_;
    SteppedContact contact_;
    std::vector<double> foretold_;            ///< secant stiffness of each step, or nothing
    std::vector<SimilarityBound> similarity_; ///< of each objective
    std::size_t at_once_;
    std::vector<Judged> judged_ = std::vector<Judged>(similarity_.size()); ///< of each objective
};

} // namespace

RescaledProblem::RescaledProblem(Model model, Target target, double max_pressure, double threshold,
                                 std::shared_ptr<ResponseMemory> memory, PhaseReach reach, Outlook outlook)
    : model_(completed(std::move(model))), target_(std::move(target)), max_pressure_(max_pressure),
      memory_(std::move(memory)), reach_(reach), outlook_(outlook), stiffest_(stiffest(model_)) {
    validate(target_);
    if (!(max_pressure > 0) || target_.highest_pressure() > max_pressure * (1 + 1e-9))
        refuse(target_.name, ": pressures up to ", target_.highest_pressure(),
               " MPa given, expected at most max-pressure, ", max_pressure, " MPa");
    std::vector<Index> all(static_cast<std::size_t>(target_.points()));
    std::iota(all.begin(), all.end(), Index{0});
    points_ = {{"similarity", all},
               {"low", points_within(target_, {0, threshold})},
               {"high", points_within(target_, {threshold, max_pressure * (1 + 1e-9)})}};
    for (const auto& [name, points] : points_) {
        if (points.empty())
            refuse("threshold: ", threshold, " MPa leaves no point of the target ", target_.name, " in the ",
                   name, " part, expected one within its pressures");
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
    if (memory_)
        if (std::optional<Response> known = memory_->find(shape_key(genome)))
            return rescaled(std::move(*known), max_pressure_);
    return of_response(genome, respond(at_scale_one(genome), model_));
}

RescaledResponse RescaledProblem::of_response(const Genome& genome, Response response) const {
    if (memory_)
        memory_->keep(shape_key(genome), response);
    return rescaled(std::move(response), max_pressure_);
}

std::unique_ptr<ga::Appraisal<RescaledResponse>> RescaledProblem::appraise(const Genome& genome) const {
    const Solver solver = model_.contact.solver;
    if (model_.accuracy > 0 || (solver != Solver::automatic && solver != Solver::nested) ||
        model_.grid.nodes > most_appraised_nodes || (memory_ && memory_->find(shape_key(genome))))
        return nullptr;
    const Genome shape = at_scale_one(genome);
    const Profile profile = sample(shape, model_.grid);
    if (is_flat(profile, shape)) // evaluate says so
        return nullptr;
    std::vector<SimilarityBound> bounds;
    for (const auto& [name, points] : points_)
        bounds.emplace_back(target_, points, max_pressure_, stiffest_);
    return std::make_unique<Steps>(*this, shape, profile, std::move(bounds));
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
