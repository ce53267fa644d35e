#include "domain/problem/appraisal.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/contact/stepped.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/problem/foretold.hpp"
#include "domain/problem/response.hpp"
#include "domain/target/similarity_bound.hpp"

#include <algorithm>
#include <limits>

namespace rough {

namespace {

/// Beyond so many nodes the nested factor may not fit.
constexpr Index most_appraised_nodes = 8192;

/// The bound of each objective. Targets of other quantities, limits and finer grids only take from it.
std::vector<SimilarityBound> bounds_of(const DesignProblem& problem) {
    const DesignSetup& setup = problem.setup();
    std::vector<SimilarityBound> bounds;
    for (const auto& objective : problem.objectives()) {
        SimilarityBound bound(*setup.max_pressure, problem.stiffest());
        for (std::size_t t = 0; t < setup.targets.size(); ++t)
            if (setup.targets[t].quantity == Quantity::stiffness)
                bound.add(setup.targets[t], problem.points_of(objective.name, t));
        bounds.push_back(std::move(bound));
    }
    return bounds;
}

/// One genome's load steps as far as they are solved.
class Steps : public ga::Appraisal<DesignOutcome> {
  public:
    Steps(const DesignProblem& problem, const Model& model, Genome shape, const Profile& profile)
        : problem_(problem), shape_(std::move(shape)), range_(displacement_range(profile, model.body.kernel)),
          full_contact_(full_contact_stiffness(profile.nodes(), profile.spacing, model.body)),
          contact_(profile, model.body, step_displacements(profile, model.body, model.loading, model.contact),
                   model.contact),
          foretold_(problem.setup().outlook == Outlook::foretold
                        ? foretold_secants(profile, model, contact_.displacements())
                        : std::vector<double>()),
          similarity_(bounds_of(problem)), at_once_(std::max<std::size_t>(1, count() / 20)) {
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
    std::optional<DesignOutcome> outcome() override {
        if (!contact_.done())
            return std::nullopt;
        if (!contact_.is_own_choice())
            return problem_.evaluate(shape_);
        return problem_.of_responses(shape_,
                                     {response_of(contact_.steps(), Solver::nested, range_, full_contact_)});
    }

  private:
    std::size_t count() const { return contact_.displacements().size(); }

    struct Judged {
        double bound = std::numeric_limits<double>::infinity();
        std::size_t steps = 0; ///< that were known then
    };

    const DesignProblem& problem_;
    Genome shape_;
    double range_;
    double full_contact_; ///< stiffness, MPa/mm
    SteppedContact contact_;
    std::vector<double> foretold_;            ///< secant stiffness of each step, or nothing
    std::vector<SimilarityBound> similarity_; ///< of each objective
    std::size_t at_once_;
    std::vector<Judged> judged_ = std::vector<Judged>(similarity_.size()); ///< of each objective
};

} // namespace

std::unique_ptr<ga::Appraisal<DesignOutcome>> step_by_step(const DesignProblem& problem,
                                                           const Genome& genome) {
    const DesignSetup& setup = problem.setup();
    const Solver solver = setup.model.contact.solver;
    if (!setup.max_pressure || setup.model.accuracy > 0 || setup.model.grid.is_area() ||
        (solver != Solver::automatic && solver != Solver::nested) ||
        setup.model.grid.nodes > most_appraised_nodes)
        return nullptr;
    const Genome shape = at_scale_one(genome, setup);
    const Profile profile = sample(shape, setup.model.grid);
    if (is_flat(profile, shape)) // evaluate says so
        return nullptr;
    return std::make_unique<Steps>(problem, setup.model, shape, profile);
}

} // namespace rough
