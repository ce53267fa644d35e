#pragma once

#include "ga/refinement/levenberg_marquardt.hpp"
#include "ga/stage.hpp"

namespace ga {

/// Optional: the fitness's derivatives with respect to all genes.
template <class P>
concept Differentiable = HasGenes<P> &&
    requires(const P& problem, const typename P::Genome& genome, const std::string& objective) {
    { problem.gradient(genome, objective) } -> std::same_as<std::vector<double>>;
};

/// What refinement by a method asks of a problem.
template <class P, class M>
concept Refinable = Problem<P> && HasGenes<P> &&(Sensitive<P> || !std::derived_from<M, ResidualMethod>);

/// Moves the chosen genes of every individual by a local method, individuals in parallel, and scores the
/// answers; an individual that did not get better stays as it was. Bounds and the choice of genes are those
/// of the genome as it was when the individual was first refined. Failed individuals are left alone.
template <class M, class Choice>
struct Refine : Operator {
    M method;         ///< what moves them
    Choice variables; ///< Variables<G>, or EveryGene

    /// `refine method genes=variables`.
    Refine(M m, Choice v) : method(std::move(m)), variables(std::move(v)) {}
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "refine " + method.text + " genes=" + variables.name; }
    void check(Known& known) const {
        known.need_score(text());
        known.objective(text(), *known.scored);
    }

    template <Problem P>
    void check_problem() const {
        if (method.needs_gradient && !Differentiable<P>)
            throw UsageError(
                "stage '" + text() +
                "' needs the problem's gradient; expected a method without, e.g. nlopt LN_COBYLA");
    }

    template <class P>
    requires Refinable<P, M> Population<typename P::Genome>
    operator()(Population<typename P::Genome> population, Context<P>& context) const {
        using G = typename P::Genome;
        std::vector<Job<P>> jobs;
        for (auto& individual : population)
            if (!individual.fitness.has_failed())
                jobs.push_back({&individual});
        // What is left of the budget is shared out beforehand, after one evaluation for each answer.
        const long count = static_cast<long>(jobs.size());
        if (context.evaluator().spent(count))
            throw Stopped{"evaluation budget spent"};
        const long left =
            std::max(0L, context.evaluator().budget().evaluations - context.counters().asked - count);
        parallel_for(jobs.size(), context.threads(), [&](std::size_t i) {
            jobs[i].limit = left / count + (static_cast<long>(i) < left % count ? 1 : 0);
            work(jobs[i], context, context.stream(i)());
        });
        Population<G> answers;
        for (Job<P>& job : jobs) {
            context.counters().gradients += job.gradients;
            context.counters().asked += job.gradients + job.evaluations;
            context.counters().evaluations += job.evaluations;
            if (!job.individual->origin)
                job.individual->origin = std::make_shared<const G>(job.individual->genome);
            answers.push_back(*job.individual);
            if (job.answer) {
                answers.back().genome = std::move(*job.answer);
                answers.back().fitness = {};
            }
        }
        if (!answers.empty())
            context.score(answers, jobs.front().individual->fitness.objective(), Patience::finish);
        for (std::size_t i = 0; i < jobs.size(); ++i)
            if (answers[i].value() > jobs[i].individual->value())
                *jobs[i].individual = std::move(answers[i]);
        // A search that was cut short is no answer of this stage; what it found stands as the best so far.
        if (const Watch& watch = context.evaluator().watch(); watch.expired())
            throw Stopped{watch.reason()};
        return population;
    }
    ///@}

  private:
    template <class P>
    struct Job {
        Individual<typename P::Genome>* individual;
        long limit = 0;
        std::optional<typename P::Genome> answer = {}; ///< where the method moved
        long evaluations = 0, gradients = 0;
    };

    template <class P>
    void work(Job<P>& job, Context<P>& context, std::uint64_t seed) const {
        const P& problem = context.problem();
        const auto& genome = job.individual->genome;
        std::vector<Variable> moving =
            variables.template on<P>(problem, job.individual->origin ? *job.individual->origin : genome);
        std::erase_if(moving, [](const Variable& variable) { return !(variable.lower < variable.upper); });
        if (moving.empty())
            return;
        const std::vector<double> genes = genes_of(problem, genome);
        const auto n = static_cast<Eigen::Index>(moving.size());
        const auto at = [&](const Eigen::VectorXd& x) {
            std::vector<double> moved = genes;
            for (Eigen::Index i = 0; i < n; ++i)
                moved[moving[static_cast<std::size_t>(i)].gene] = x[i];
            return with_genes(problem, genome, std::move(moved));
        };
        const std::string& objective = job.individual->fitness.objective();
        const Name name = job.individual->fitness.objective_name();
        const std::size_t which = context.objective_index(objective);

        Landscape land;
        land.seed = seed;
        land.start.resize(n), land.lower.resize(n), land.upper.resize(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Variable& variable = moving[static_cast<std::size_t>(i)];
            land.lower[i] = variable.lower;
            land.upper[i] = variable.upper;
            land.start[i] = std::clamp(genes[variable.gene], variable.lower, variable.upper);
        }
        land.exhausted = [&] {
            return job.evaluations + job.gradients >= job.limit || context.evaluator().watch().expired();
        };
        land.fitness = [&](const Eigen::VectorXd& x) {
            ++job.evaluations;
            const Fitness fitness =
                Evaluator<P>::judge(context.evaluator().evaluate(at(x)), problem.objectives()[which], name);
            return fitness.value();
        };
        if constexpr (Differentiable<P>)
            land.gradient = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                ++job.gradients;
                try {
                    const std::vector<double> all = problem.gradient(at(x), objective);
                    Eigen::VectorXd chosen(n);
                    for (Eigen::Index i = 0; i < n; ++i)
                        chosen[i] = all[moving[static_cast<std::size_t>(i)].gene];
                    return chosen;
                } catch (const std::exception&) {
                    return {};
                }
            };
        if constexpr (Sensitive<P>)
            land.sensitivity = [&](const Eigen::VectorXd& x) -> std::optional<Sensitivity> {
                ++job.gradients;
                try {
                    const Sensitivity all = problem.sensitivity(at(x), objective);
                    Sensitivity chosen{all.residuals, Eigen::MatrixXd(all.residuals.size(), n)};
                    for (Eigen::Index i = 0; i < n; ++i)
                        chosen.jacobian.col(i) = all.jacobian.col(
                            static_cast<Eigen::Index>(moving[static_cast<std::size_t>(i)].gene));
                    if (chosen.residuals.size() == 0 || !chosen.residuals.allFinite() ||
                        !chosen.jacobian.allFinite())
                        return std::nullopt;
                    return chosen;
                } catch (const std::exception&) {
                    return std::nullopt;
                }
            };
        const Eigen::VectorXd x = method.improve(land);
        if (x != land.start)
            job.answer = at(x);
    }
};

/// A named choice of variables as refinement uses it.
template <class G>
struct ChosenGenes {
    std::string name;                                  ///< as text writes it
    std::function<std::vector<Variable>(const G&)> of; ///< of a genome
    /// The choice for that genome.
    template <class P>
    std::vector<Variable> on(const P&, const G& genome) const {
        return of(genome);
    }
};

/// Every gene within the problem's own bounds.
struct EveryGene {
    std::string name = "all"; ///< as text writes it
    /// The problem's bounds for that genome.
    template <Bounded P>
    std::vector<Variable> on(const P& problem, const typename P::Genome& genome) const {
        return problem.bounds(genome);
    }
};

/// The stage `refine method genes=NAME`.
template <class M, class G>
requires std::derived_from<M, Method> Refine<M, ChosenGenes<G>> refine(M method,
                                                                       const Variables<G>& variables) {
    return {std::move(method), {variables.name, variables.of}};
}
/// The stage `refine method`: every gene within the problem's bounds.
template <class M>
requires std::derived_from<M, Method> Refine<M, EveryGene> refine(M method) {
    return {std::move(method), {}};
}

} // namespace ga
