#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Options of a run.
struct RunOptions {
    std::string variant = "pipeline"; ///< first word of every stage's path; does not affect random numbers
    std::uint64_t seed = 1;           ///< seed of every random stream
    int threads = 0;                  ///< number of threads of `run`, 0 for OpenMP's default; not used by `run_by`
    std::size_t memory_bytes = std::size_t{1} << 30; ///< memory for known outcomes; does not affect a result
    Budget budget = {};                              ///< limits at which the run stops early
    /// Memory for one population; a run that would exceed it ends with its current population.
    std::size_t population_bytes = std::size_t{1} << 30;
};

/// The result of a run.
template <class G>
struct Result {
    /// The last population. A stopped run returns individuals of its last population and of the generation's
    /// start, best first. They are the individuals that are scored under the most frequent policy.
    Population<G> population;
    std::optional<Individual<G>> best; ///< the best of the whole run under the problem's first objective
    Counters counters;                 ///< evaluations and derivatives of the run
    std::vector<std::string> notes;    ///< remarks of stages, each under its path
    std::string stopped;               ///< why the run ended early; empty if it did not
    bool is_dead_end = false;          ///< whether the run could not continue, also without a limit
    double seconds = 0;                ///< wall time, including that before each resumption
    Population<G> front = {};          ///< individuals of `population` that no other one dominates
};

/// The properties of an unscored population. Throws UsageError if the problem has no objective.
template <Problem P>
[[gnu::cold]] CheckState known_of(const P& problem) {
    CheckState known;
    for (const auto& objective : problem.objectives()) known.objectives.push_back(objective.name);
    known.has_gradient = has_gradient(problem);
    if (known.objectives.empty()) throw UsageError("the problem has no objective; define at least one");
    return known;
}
/// Throws UsageError if the pipeline cannot work on this problem and population.
template <Problem P>
[[gnu::cold]] void check(const Pipeline<P>& pipeline, const P& problem, const PopulationOf<P>& population) {
    CheckState known = known_of(problem);
    known.nobody = population.empty();
    if (known.nobody && !pipeline.begins())
        throw UsageError("the population is empty; give at least one individual, or begin with sample");
    if (!known.nobody) known.at_most = population.size();
    if (!known.nobody && comparable(population)) known.scored = population.front().fitness.objective();
    pipeline.check(known);
    pipeline.check_end(known);
}

/// A number that identifies a run by its pipeline, seed, objectives and start population.
template <Problem P>
[[gnu::cold]] std::uint64_t identity_of_run(const Pipeline<P>& pipeline, const P& problem, std::uint64_t seed,
                                            const PopulationOf<P>& population) {
    std::uint64_t key = fold(fold(0, seed), pipeline.text());
    for (const auto& objective : problem.objectives())
        key = fold(fold(key, objective.name), objective.minimise ? 1 : 0);
    for (const auto& individual : population)
        key = fold(fold(key, individual.identity), identify(problem, individual.genome).low);
    return key;
}

/// The population that a stopped run returns: the individuals that are scored under the most frequent policy,
/// best first.
template <class G>
[[gnu::cold]] Population<G> salvaged(Population<G> population) {
    std::erase_if(population, [](const auto& individual) { return !individual.fitness.known(); });
    std::map<std::string, std::size_t> policies;
    for (const auto& individual : population) ++policies[individual.fitness.objective()];
    std::string policy;
    for (const auto& [name, count] : policies)
        if (policy.empty() || count > policies[policy]) policy = name;
    std::erase_if(population, [&](const auto& individual) { return individual.fitness.objective() != policy; });
    return best_of(without_levels(std::move(population)), all_individuals);
}

/// Makes the identities of a population unique; returns the first free identity.
template <class G>
[[gnu::cold]] Identity with_identities_unique(Population<G>& population) {
    Identity next = 0;
    for (const auto& individual : population) next = std::max(next, individual.identity + 1);
    std::set<Identity> taken;
    for (auto& individual : population)
        if (!taken.insert(individual.identity).second) individual.identity = next++;
    return next;
}

/// Scores a start population again if this problem has an objective of the same name, because another problem
/// may have computed the values. Afterwards the run knows its best start.
template <Problem P>
[[gnu::cold]] void score_given(PopulationOf<P>& population, Context<P>& context) {
    if (population.empty() || !comparable(population)) return;
    const std::string objective = population.front().fitness.objective();
    if (std::ranges::none_of(context.problem().objectives(), [&](const auto& each) { return each.name == objective; }))
        return;
    for (auto& individual : population) individual.fitness = {};
    const typename Context<P>::Scope scope(context.position, Name("given"), 0);
    context.score(population, objective);
    context.show(population);
}

/// Runs a pipeline on a population. `evaluator` makes every call of `evaluate` and computes every derivative.
/// Throws UsageError before any evaluation if the pipeline cannot work. The same seed gives the same bits for
/// any evaluator with the same outcomes (ga/README.md, "Guarantees").
/// @param population  may be empty if the pipeline begins with `sample`
template <Problem P, class G = typename P::Genome>
[[gnu::cold, gnu::noinline]] Result<G>
run_by(Evaluator<P>& evaluator, const std::type_identity_t<Pipeline<P>>& pipeline, const P& problem,
       Population<G> population, const RunOptions& options = {}, std::vector<Observer<G>> observers = {},
       Checkpointer<P>* checkpointer = nullptr) {
    check(pipeline, problem, population);
    for (std::size_t i = 0; i < population.size(); ++i)
        if (!is_valid(problem, population[i].genome))
            throw UsageError("start " + std::to_string(i + 1) +
                             " is not a genome of the problem; give one of its length, with finite numbers or "
                             "each of 0 to n - 1 once");
    const Identity next = with_identities_unique(population);
    Ledger<P> ledger(problem, evaluator, options.memory_bytes, options.budget);
    Context<P> context(ledger, StagePosition<G>(options.variant, options.seed), next, options.population_bytes,
                       std::move(observers), checkpointer);
    Frame<G> outermost; // for states outside every loop
    context.state.loops.push_back(&outermost);
    Result<G> result;
    try {
        std::optional<Population<G>> answer;
        if (checkpointer) {
            if (auto kept = checkpointer->begin(ledger, identity_of_run(pipeline, problem, options.seed, population)))
                context.resume(std::move(*kept));
            answer = checkpointer->answer();
        }
        const bool known = answer.has_value();
        if (!known && context.state.saved.empty()) score_given(population, context);
        result.population = known ? std::move(*answer) : pipeline(std::move(population), context);
        if (checkpointer && !known) checkpointer->write(context.snapshot(), ledger, &result.population);
        if (ledger.all_failed()) throw Stopped{ledger.failure_text(), true};
    } catch (const Stopped& stop) {
        // If one island cannot continue, a stop may have ended other islands early.
        result.is_dead_end = stop.is_dead_end && !context.watch().expired();
        result.stopped = stop.is_dead_end == result.is_dead_end ? stop.reason : context.watch().reason();
        if (context.state.stopped_population)
            result.population = salvaged(std::move(*context.state.stopped_population));
        if (result.population.empty() && context.best()) result.population = {*context.best()};
    }
    if (comparable(result.population)) result.front = ga::front_of(result.population);
    result.best = context.best();
    result.counters = context.counters();
    result.notes = context.state.notes;
    if (checkpointer && !checkpointer->trouble().empty()) result.notes.push_back(checkpointer->trouble());
    result.seconds = context.seconds();
    return result;
}

/// Runs a pipeline as run_by() does, with the evaluations spread over threads.
template <Problem P, class G = typename P::Genome>
[[gnu::cold]] Result<G> run(const std::type_identity_t<Pipeline<P>>& pipeline, const P& problem,
                            Population<G> population, const RunOptions& options = {},
                            std::vector<Observer<G>> observers = {}, Checkpointer<P>* checkpointer = nullptr) {
    OnThreads<P> threads(options.threads);
    return run_by(threads, pipeline, problem, std::move(population), options, std::move(observers), checkpointer);
}

} // namespace ga
