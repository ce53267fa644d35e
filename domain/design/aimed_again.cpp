#include "domain/design/aimed_again.hpp"

#include "domain/design/coarse_to_fine.hpp"
#include "domain/design/judging.hpp"
#include "domain/design/pipelines.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>

namespace rough {

namespace {

/// Steps that no search has seen, and up to how many nodes a finer grid confirms, too.
constexpr int confirming_steps = 16;
constexpr Index confirmed_on_finer = 1024;
/// So often a search aims again, on an area and on a line; a line's way, whose steps cost little.
constexpr int most_on_area = 2, most_on_line = 4;
const char* const on_own_line = "score stepped | refine lm 20 sharpen=2 | best 1";

/// What an answer is confirmed by: load steps on a line that no search has seen.
class Confirmation {
  public:
    explicit Confirmation(const DesignSetup& searched) {
        if (searched.model.grid.is_area())
            return;
        finest_ = in_finer_steps(as_reported(searched), confirming_steps);
        if (finest_->model.grid.nodes <= confirmed_on_finer)
            finest_->model.grid = refined(finest_->model, judged_refinement).grid;
    }
    /// The answer's misfits there; nothing on an area, or where it has none: those there are stand.
    std::vector<Eigen::VectorXd> of(const Genome& genome) const {
        try {
            if (finest_)
                return misfits_of(*finest_, respond(*finest_, genome, finest_->model));
        } catch (const std::exception&) { // as said
        }
        return {};
    }

  private:
    std::optional<DesignSetup> finest_;
};

} // namespace

bool is_confirmed(const Answer& answer) {
    const auto& misfits = answer.judgement.confirming;
    return misfits.empty() || answer.judged() - least_similarity(misfits) <= settled;
}

SearchResult aimed_again(SearchResult result, const SearchOptions& options, const std::string& name,
                         const std::vector<ga::Observer<Genome>>& observers, double enough, double took) {
    const ga::Stopwatch clock;
    const DesignSetup& setup = result.setup;
    const bool area = setup.model.grid.is_area();
    const char* const way = area ? on_own_grid : on_own_line;
    const Judge judge(as_reported(ending(setup, options.seconds, options.stop)),
                      ga::thread_count(options.threads));
    const Confirmation confirmation(setup);
    result.best.judgement.confirming = confirmation.of(result.best.genome);
    // And on a line confirming, after each search.
    const double judging = area ? result.best.judgement.seconds : 2 * clock.seconds();
    took = std::max(took, judging);
    ga::RunOptions run;
    run.seed = options.seed;
    run.threads = options.threads;
    Answer latest = result.best;
    int missed = 0;
    bool aimed_better = false;
    for (int round = 1; round <= (area ? most_on_area : most_on_line); ++round) {
        const double now = clock.seconds();
        const long left = options.evaluations - result.counters.asked;
        if (!result.best.is_judged() || (result.best.judged() >= enough && is_confirmed(result.best)) ||
            left < 1 || now + took > options.seconds || (options.stop && options.stop->load()))
            break;
        run.variant = name + "-" + std::to_string(round + 1);
        run.budget = {left, options.seconds - now - judging, options.stop};
        const DesignSetup aimed =
            allowing_for(ending(setup, run.budget.seconds, options.stop), latest.judgement);
        try {
            const auto found = ga::run(design_pipeline(aimed, way), DesignProblem(aimed),
                                       ga::population(std::vector<Genome>{latest.genome}), run, observers);
            result.counters = sum(result.counters, found.counters);
            result.pipeline += std::string("\n") + way;
            latest = judged_answer(judge, found.population.at(0).genome);
        } catch (const std::exception&) { // no curve: the answer before stands
            break;
        }
        if (!latest.is_judged())
            break;
        latest.judgement.confirming = confirmation.of(latest.genome);
        const auto rank = [](const Answer& a) {
            return std::tuple(a.within_limits, is_confirmed(a), a.judged());
        };
        if (rank(latest) > rank(result.best)) {
            aimed_better = true;
            missed = 0;
            result.best = result.alternatives.front() = latest;
        } else if (area || ++missed == 2) {
            break;
        }
        took = clock.seconds() - now;
    }
    if (aimed_better)
        result.notes.push_back("the grid's and the load steps' errors were allowed for in the aim");
    return result;
}

} // namespace rough
