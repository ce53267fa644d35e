#pragma once

/// @file
/// Refinement by every method of the engine. It is not part of ga/ga.hpp, because it needs Eigen and NLopt.
#include "ga/pipeline/stage.hpp"
#include "ga/refinement/levenberg_marquardt.hpp"
#include "ga/refinement/nlopt.hpp"

namespace ga {

/// A problem that a method of refinement works for.
template <class P, class M>
concept Refinable = Problem<P> && HasGenes<P> &&(Sensitive<P> || !std::derived_from<M, ResidualMethod>);

/// The refinement of one individual by a method. It evaluates the points that the method requests.
template <Problem P>
class Search {
  public:
    using Genome = typename P::Genome; ///< genome of the problem

    /// Prepares a search. `moving` are the genes that move, `limit` is the maximum price of requests, `generation` as
    /// in EvaluationCall. The problem, the queue, the watch and the individual must outlive the search.
    Search(const P& problem, EvaluationQueue<P>& queue, const Watch& watch, const Individual<Genome>& individual,
           std::vector<Variable> moving, double limit, std::vector<std::size_t> generation = {})
        : problem_(problem), queue_(queue), watch_(watch), individual_(individual), moving_(std::move(moving)),
          limit_(limit), generation_(std::move(generation)), genes_(genes_of(problem, individual.genome)) {
        for (const Variable& variable : moving_) {
            if (variable.gene >= genes_.size())
                throw UsageError("refine: gene " + std::to_string(variable.gene) +
                                 " may move but does not exist; name one below " + std::to_string(genes_.size()));
            places_.push_back(static_cast<Eigen::Index>(variable.gene));
        }
        const auto& objectives = problem.objectives();
        for (std::size_t i = 0; i < objectives.size(); ++i)
            if (objectives[i].name == individual.fitness.objective()) objective_ = i;
    }

    /// The genome to which the method moved the individual; none if it did not move it.
    std::optional<Genome> by(const Method& method, std::uint64_t seed) {
        const auto n = static_cast<Eigen::Index>(moving_.size());
        if (n == 0) return std::nullopt;
        Landscape land;
        land.seed = seed;
        land.start.resize(n), land.lower.resize(n), land.upper.resize(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Variable& variable = moving_[static_cast<std::size_t>(i)];
            land.lower[i] = variable.lower;
            land.upper[i] = variable.upper;
            land.start[i] = std::clamp(genes_[variable.gene], variable.lower, variable.upper);
        }
        land.exhausted = [this] { return stopped_ || is_spent() || watch_.expired(); };
        land.fitness = [this](const Eigen::VectorXd& x) {
            const Fitness found = fitness(x);
            return found.known() && found.feasible() ? found.merit() : -HUGE_VAL;
        };
        if constexpr (Constrained<P>)
            land.constrained = [this](const Eigen::VectorXd& x) {
                // called for the fitness, then for the constraints
                if (seen_at_.size() != x.size() || seen_at_ != x) {
                    seen_fitness_ = fitness(x);
                    seen_at_ = x;
                }
                return std::pair(seen_fitness_.known() ? seen_fitness_.merit() : -HUGE_VAL, violations_);
            };
        if (has_gradient(problem_)) land.gradient = [this](const Eigen::VectorXd& x) { return gradient(x); };
        if constexpr (Sensitive<P>) land.sensitivity = [this](const Eigen::VectorXd& x) { return sensitivity(x); };
        const Eigen::VectorXd x = method.improve(land);
        return x == land.start ? std::nullopt : std::optional(at(x));
    }

    /// Why the first missing derivative is missing; null if none is.
    const Reason& missing_derivative() const { return missing_derivative_; }

  private:
    static Eigen::Map<Eigen::VectorXd> as_vector(std::vector<double>& numbers) {
        return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
    }
    Genome at(const Eigen::VectorXd& x) const {
        std::vector<double> moved = genes_;
        as_vector(moved)(places_) = x;
        Genome genome = with_genes(problem_, individual_.genome, std::move(moved));
        if constexpr (Repairs<P>) return problem_.repair(genome);
        return genome;
    }
    const auto& objective() const { return problem_.objectives()[objective_]; }

    /// Whether the limit does not allow every kind of request any more.
    bool is_spent() const {
        const LevelPrice price = price_of(problem_, objective().level);
        return spent_ + std::max(price.evaluation, price.gradient) > limit_;
    }
    /// Makes a request of this price. It stays unanswered if the run has to stop or the limit is reached.
    void ask(EvaluationRequest<P>& request, double price) {
        if (stopped_ || spent_ + price > limit_) return;
        spent_ += price;
        try {
            queue_.serve(request);
        } catch (const Stopped&) {
            stopped_ = true;
        }
    }

    /// The fitness at a point, and the violations of constraints there; unknown if it was not evaluated.
    Fitness fitness(const Eigen::VectorXd& x) {
        Fitness found;
        violations_.resize(0);
        if (!x.allFinite()) return found;
        const Genome genome = at(x);
        EvaluationRequest<P> request;
        request.generation = generation_;
        request.outcomes.push_back({&genome, true, 0, objective().level});
        request.use = [&] {
            const auto& wanted = request.outcomes.front();
            if (!wanted.is_answered()) return;
            found = fitness_of(problem_, *wanted.answer, objective(), individual_.fitness.objective_name());
            if (found.has_failed()) return request.fail(found, 1);
            if constexpr (Constrained<P>) {
                auto each = violations_of(problem_, std::get<typename P::Outcome>(*wanted.answer));
                violations_ = as_vector(each);
            }
        };
        ask(request, price_of(problem_, objective().level).evaluation);
        return found;
    }
    /// The slope at a point; unknown parts are empty.
    Slope<P> slope(const Eigen::VectorXd& x, bool of_residuals) {
        Slope<P> slope{x.allFinite() ? at(x) : individual_.genome, individual_.fitness.objective_name(),
                       objective().level, of_residuals};
        EvaluationRequest<P> request;
        request.slopes.push_back(&slope);
        if (x.allFinite()) ask(request, price_of(problem_, objective().level).gradient);
        if (slope.failure && !missing_derivative_) missing_derivative_ = slope.failure;
        return slope;
    }
    Eigen::VectorXd gradient(const Eigen::VectorXd& x) {
        Slope<P> found = slope(x, false);
        if (found.gradient.empty()) return {};
        return (objective().minimise ? -1.0 : 1.0) * as_vector(found.gradient)(places_);
    }
    std::optional<Sensitivity> sensitivity(const Eigen::VectorXd& x) {
        const Slope<P> found = slope(x, true);
        if (!found.sensitivity) return std::nullopt;
        const Sensitivity& all = *found.sensitivity;
        return Sensitivity{all.residuals, all.jacobian(Eigen::all, places_)};
    }

    const P& problem_;
    EvaluationQueue<P>& queue_;
    const Watch& watch_;
    const Individual<Genome>& individual_;
    std::vector<Variable> moving_;
    double limit_, spent_ = 0; ///< prices
    std::vector<std::size_t> generation_;
    std::vector<double> genes_;
    std::vector<Eigen::Index> places_; ///< indices of the genes that move
    std::size_t objective_ = 0;
    bool stopped_ = false;
    Reason missing_derivative_;
    Eigen::VectorXd violations_; ///< at the last evaluated point
    Eigen::VectorXd seen_at_;    ///< the last point of `constrained`
    Fitness seen_fitness_;       ///< there
};

/// The choice of all genes; each moves between the problem's bounds.
struct EveryGene {
    std::string name = "all"; ///< name of the choice in a stage's text
};

/// Moves the chosen genes of every individual by a method of refinement, and scores the results. Individuals
/// are refined in parallel (`Rounds`). Failed individuals and individuals that do not improve stay unchanged.
/// The genes that move and their bounds are chosen for the genome before its first refinement.
template <class M, class Choice>
struct Refine : Operator {
    M method;         ///< method that moves the genes
    Choice variables; ///< genes that may move: Variables<G>, or EveryGene

    std::string text() const { return "refine " + method.text + " genes=" + variables.name; }
    void check(CheckState& known) const {
        known.need_one_objective(text());
        if (method.needs_gradient && !known.has_gradient)
            throw UsageError("stage '" + text() +
                             "' needs the problem's gradient; use a method without one, e.g. nlopt LN_COBYLA");
    }

    template <class P>
    requires Refinable<P, M> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        using G = typename P::Genome;
        std::vector<Individual<G>*> jobs;
        for (auto& individual : population)
            if (!individual.fitness.has_failed()) jobs.push_back(&individual);
        std::vector<std::vector<Variable>> genes(jobs.size());
        std::vector<Work> work(jobs.size());
        parallel_for(jobs.size(), context.threads(), [&](std::size_t i) {
            const G& original = jobs[i]->origin ? *jobs[i]->origin : jobs[i]->genome;
            if constexpr (std::same_as<Choice, EveryGene>)
                genes[i] = checked_bounds(context.problem(), original);
            else
                genes[i] = variables.of(original, work[i]);
            std::erase_if(genes[i], [](const Variable& gene) { return !(gene.lower < gene.upper); });
        });
        context.charge(work);
        // One evaluation is reserved for each result. The rest of the budget is divided before any search.
        const auto count = static_cast<double>(jobs.size());
        const std::size_t which = jobs.empty() ? 0 : context.objective_index(jobs.front()->fitness.objective());
        const double price = price_of(context.problem(), context.problem().objectives()[which].level).evaluation;
        const double left = std::floor(context.ledger().left_after(count * price));
        if (left <= 0) {
            context.state.stopped_population = population;
            throw Stopped{"evaluation budget spent"};
        }
        const double share = std::floor(left / count), rest = left - share * count;
        std::vector<std::optional<G>> found(jobs.size());
        std::vector<Reason> missing(jobs.size());
        const int threads = context.ledger().evaluator().threads();
        Rounds<P>::run(jobs.size(), context.queue(), threads, [&](std::size_t i, EvaluationQueue<P>& queue) {
            const double limit = share + (static_cast<double>(i) < rest ? 1 : 0);
            Search<P> search(context.problem(), queue, context.watch(), *jobs[i], std::move(genes[i]), limit,
                             context.position.generations());
            found[i] = search.by(method, context.stream(i)());
            missing[i] = search.missing_derivative();
        });
        if (const auto first = std::ranges::find_if(missing, [](const Reason& why) { return why != nullptr; });
            first != missing.end() && !context.watch().expired())
            context.note_missing_derivative(**first);
        Population<G> answers;
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            if (!jobs[i]->origin) jobs[i]->origin = std::make_shared<const G>(jobs[i]->genome);
            answers.push_back(*jobs[i]);
            if (found[i]) {
                answers.back().genome = std::move(*found[i]);
                answers.back().fitness = {};
            }
        }
        std::optional<Stopped> stop;
        try {
            if (!answers.empty()) context.score(answers, jobs.front()->fitness.objective(), StopMode::after_request);
        } catch (const Stopped& stopped) {
            stop = stopped;
        }
        // An interrupted search is not a result of this stage; the best point so far is kept.
        if (!stop && context.watch().expired()) stop = Stopped{context.watch().reason()};
        for (std::size_t i = 0; i < jobs.size(); ++i)
            if (answers[i].fitness.known() && better(answers[i].fitness, jobs[i]->fitness))
                *jobs[i] = std::move(answers[i]);
        if (stop) {
            context.state.stopped_population = population;
            throw *stop;
        }
        return population;
    }
};

/// The stage `refine method genes=NAME`.
template <class M, class G>
requires std::derived_from<M, Method> Refine<M, Variables<G>> refine(M method, Variables<G> variables) {
    return {{}, std::move(method), std::move(variables)};
}
/// The stage `refine method` for all genes; each moves between the problem's bounds.
template <class M>
requires std::derived_from<M, Method> Refine<M, EveryGene> refine(M method) { return {{}, std::move(method), {}}; }

} // namespace ga
