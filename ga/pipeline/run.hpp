#pragma once

#include "ga/pipeline/stage.hpp"
#include "ga/problem/permutation.hpp"

#include <set>

namespace ga {

/// How a pipeline is run.
struct RunOptions {
    std::string variant = "pipeline"; ///< first word of every path; decides no random number
    std::uint64_t seed = 1;           ///< of every random stream
    int threads = 0;                  ///< 0: as many as OpenMP has; decides no result
    std::size_t memory_bytes = std::size_t{1}
                               << 30; ///< for outcomes known before a stage; does not affect the result
    Budget budget = {};               ///< when to stop before the pipeline ends
    /// For one population; a run whose population would exceed it ends with what it has.
    std::size_t population_bytes = std::size_t{1} << 30;
};

/// What a run gives back.
template <class G>
struct Result {
    /// The pipeline's answer. When the run was stopped, what it had in hand: the scored of the population and
    /// what its generation kept of its start, best first.
    Population<G> population;
    std::optional<Individual<G>> best; ///< the best ever scored under the problem's first objective
    Counters counters;                 ///< what was paid for
    std::vector<std::string> notes;    ///< remarks of stages, each under its path
    std::string stopped;               ///< why the run ended before its pipeline; empty when it did not
    double seconds = 0;                ///< in all the processes that carried the run
    Population<G> front = {};          ///< of the population, those that no other betters
};

/// Throws UsageError when the pipeline cannot work on this problem and population.
template <Problem P>
[[gnu::cold]] void check(const Stage<P>& pipeline, const P& problem, const PopulationOf<P>& population) {
    CheckState known;
    for (const auto& objective : problem.objectives())
        known.objectives.push_back(objective.name);
    if (known.objectives.empty())
        throw UsageError("the problem has no objective; expected one at least");
    known.nobody = population.empty();
    if (known.nobody && !pipeline.begins())
        throw UsageError("the population is empty; expected one individual at least, or sample before all");
    if (!known.nobody && comparable(population))
        known.scored = population.front().fitness.objective();
    pipeline.check(known);
    pipeline.check_end(known);
}

/// What makes a run the one it is: pipeline, seed, objectives and start.
template <Problem P>
[[gnu::cold]] std::uint64_t identity_of_run(const Stage<P>& pipeline, const P& problem, std::uint64_t seed,
                                            const PopulationOf<P>& population) {
    std::uint64_t key = fold(fold(0, seed), pipeline.text());
    for (const auto& objective : problem.objectives())
        key = fold(fold(key, objective.name), objective.minimise ? 1 : 0);
    for (const auto& individual : population)
        key = fold(fold(key, individual.identity), identify(problem, individual.genome).low);
    return key;
}

/// What a stopped run gives back of what it had in hand: whoever is scored under the policy of most, best
/// first.
template <class G>
[[gnu::cold]] Population<G> salvaged(Population<G> in_hand) {
    std::erase_if(in_hand, [](const auto& individual) { return !individual.fitness.known(); });
    std::map<std::string, std::size_t> policies;
    for (const auto& individual : in_hand)
        ++policies[individual.fitness.objective()];
    std::string policy;
    for (const auto& [name, count] : policies)
        if (policy.empty() || count > policies[policy])
            policy = name;
    std::erase_if(in_hand, [&](const auto& individual) { return individual.fitness.objective() != policy; });
    return best_of(strict(std::move(in_hand)), everyone);
}

/// Throws UsageError on numbers that are not 0 to n - 1, each once.
[[gnu::cold]] inline void expect_permutation(const Permutation& permutation) {
    std::vector<char> seen(permutation.order.size(), 0);
    for (const auto number : permutation.order)
        if (number >= seen.size() || std::exchange(seen[number], char{1}))
            throw UsageError("a start of " + std::to_string(seen.size()) + " numbers has " +
                             std::to_string(number) + " where it cannot be; expected each from 0 to " +
                             std::to_string(seen.size() - 1) + " once");
}

/// Gives individuals whose identity another has a new one; returns the first that is free.
template <class G>
[[gnu::cold]] Identity with_identities_unique(Population<G>& population) {
    Identity next = 0;
    for (const auto& individual : population)
        next = std::max(next, individual.identity + 1);
    std::set<Identity> taken;
    for (auto& individual : population)
        if (!taken.insert(individual.identity).second)
            individual.identity = next++;
    return next;
}

/// Scores a start population that comes scored again, as another problem may have scored it, so that the run
/// knows its best.
template <Problem P>
[[gnu::cold]] void score_given(PopulationOf<P>& population, Context<P>& context) {
    if (population.empty() || !comparable(population))
        return;
    const std::string objective = population.front().fitness.objective();
    const auto& objectives = context.problem().objectives();
    const bool known = std::any_of(objectives.begin(), objectives.end(),
                                   [&](const auto& each) { return each.name == objective; });
    if (!known)
        return;
    for (auto& individual : population)
        individual.fitness = {};
    const typename Context<P>::Scope scope(context.position, Name("given"), 0);
    context.score(population, objective);
    context.show(population);
}

/// What `run_by` does once the pipeline's type is known no more.
template <Problem P, class G = typename P::Genome>
[[gnu::cold, gnu::noinline]] Result<G>
run_stage(Evaluator<P>& evaluator, const Stage<P>& stage, const P& problem, Population<G> population,
          const RunOptions& options, std::vector<Observer<G>> observers, Checkpointer<P>* keeper) {
    check(stage, problem, population);
    if constexpr (std::same_as<G, Permutation>)
        for (const auto& individual : population)
            expect_permutation(individual.genome);
    const Identity next = with_identities_unique(population);
    Ledger<P> ledger(problem, evaluator, options.memory_bytes, options.budget);
    Context<P> context(ledger, StagePosition<G>(options.variant, options.seed), next,
                       {std::move(observers), keeper, options.population_bytes});
    Frame<G> outermost; // of states outside every loop
    context.state.loops.push_back(&outermost);
    Result<G> result;
    try {
        std::optional<Population<G>> answer;
        if (keeper) {
            if (auto kept = keeper->begin(ledger, identity_of_run(stage, problem, options.seed, population)))
                context.resume(std::move(*kept));
            answer = keeper->answer();
        }
        const bool known = answer.has_value();
        if (!known && context.state.saved.empty())
            score_given(population, context);
        result.population = known ? std::move(*answer) : stage(std::move(population), context);
        ledger.expect_success();
        if (keeper && !known)
            keeper->write(context.snapshot(), ledger, &result.population);
    } catch (const Stopped& stop) {
        result.stopped = stop.reason;
        if (context.state.in_hand)
            result.population = salvaged(std::move(*context.state.in_hand));
        if (result.population.empty() && context.best())
            result.population = {*context.best()};
    }
    if (comparable(result.population))
        result.front = ga::front_of(result.population);
    result.best = context.best();
    result.counters = context.counters();
    result.notes = context.state.notes();
    if (keeper && !keeper->trouble().empty())
        result.notes.push_back(keeper->trouble());
    result.seconds = context.seconds();
    return result;
}

/// Runs a pipeline on a population, every paid call made by `evaluator`. The pipeline is checked first:
/// UsageError says what it lacks. The same seed gives the same result, bit for bit, for any evaluator of the
/// same outcomes, any number of threads and any memory, unless the run ends on seconds or a stop; with a
/// keeper, however often the process ended on the way.
/// @param population  may be empty where the pipeline begins with `sample`
template <Problem P, class Pipeline, class G = typename P::Genome>
requires(std::convertible_to<Pipeline, Stage<P>>)
    [[gnu::cold]] Result<G> run_by(Evaluator<P>& evaluator, const Pipeline& pipeline, const P& problem,
                                   Population<G> population, const RunOptions& options = {},
                                   std::vector<Observer<G>> observers = {},
                                   Checkpointer<P>* keeper = nullptr) {
    const Stage<P>& stage = pipeline;
    return run_stage(evaluator, stage, problem, std::move(population), options, std::move(observers), keeper);
}

/// The same with the paid calls spread over threads.
template <Problem P, class Pipeline, class G = typename P::Genome>
requires(std::convertible_to<Pipeline, Stage<P>>)
    [[gnu::cold]] Result<G> run(const Pipeline& pipeline, const P& problem, Population<G> population,
                                const RunOptions& options = {}, std::vector<Observer<G>> observers = {},
                                Checkpointer<P>* keeper = nullptr) {
    OnThreads<P> threads(options.threads);
    return run_by(threads, pipeline, problem, std::move(population), options, std::move(observers), keeper);
}

} // namespace ga
