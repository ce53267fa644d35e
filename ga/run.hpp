#pragma once

#include "ga/stage.hpp"

namespace ga {

/// How a pipeline is run.
struct RunOptions {
    std::string variant = "pipeline";                ///< first word of every path; decides no random number
    std::uint64_t seed = 1;                          ///< of every random stream
    int threads = 0;                                 ///< 0: as many as OpenMP has; decides no result
    std::size_t memory_bytes = std::size_t{1} << 30; ///< for known outcomes; decides no result
    /// Where `score` is followed by a stage that keeps the best or those above a threshold, evaluations of
    /// the others are given up on the way if the problem can (Appraises). Same survivors, fewer seconds; what
    /// observers see after such a score is the survivors' rivals only. Decides no survivor.
    bool screening = false;
    Budget budget = {}; ///< when to stop before the pipeline ends
};

/// What a run gives back.
template <class G>
struct Result {
    Population<G> population;          ///< the pipeline's answer; when stopped, the best so far alone
    std::optional<Individual<G>> best; ///< the best ever scored under the problem's first objective
    Counters counters;                 ///< what was paid for
    std::vector<std::string> notes;    ///< remarks of stages, each under its path
    std::string stopped;               ///< why the run ended before its pipeline; empty when it did not
    double seconds = 0;                ///< in all the processes that carried the run
};

/// Throws UsageError when the pipeline cannot work on this problem and population.
template <Problem P>
void check(const Stage<P>& pipeline, const P& problem, const Population<typename P::Genome>& population) {
    if (population.empty())
        throw UsageError("the population is empty; expected one individual at least");
    Known known;
    for (const auto& objective : problem.objectives())
        known.objectives.push_back(objective.name);
    if (known.objectives.empty())
        throw UsageError("the problem has no objective; expected one at least");
    const Fitness& first = population.front().fitness;
    const bool scored = std::all_of(population.begin(), population.end(), [&](const auto& individual) {
        return individual.fitness.known() && individual.fitness.known(first.objective_name());
    });
    if (scored)
        known.scored = first.objective();
    pipeline.check(known);
}

/// What makes a run the one it is: pipeline, seed, objectives and start.
template <Problem P>
std::uint64_t identity_of_run(const Stage<P>& pipeline, const P& problem, std::uint64_t seed,
                              const Population<typename P::Genome>& population) {
    std::uint64_t key = fold(fold(0, seed), pipeline.text());
    for (const auto& objective : problem.objectives())
        key = fold(key, objective.name);
    for (const auto& individual : population)
        key = fold(fold(key, individual.identity), identify(problem, individual.genome).low);
    return key;
}

/// Runs a pipeline on a population. The pipeline is checked first: UsageError says what it lacks. The same
/// seed gives the same result, bit for bit, for any number of threads and any memory, unless the run ends on
/// seconds or a stop; with a keeper, however often the process ended on the way.
template <Problem P, class Pipeline, class G = typename P::Genome>
requires(std::convertible_to<Pipeline, Stage<P>>) Result<G> run(const Pipeline& pipeline, const P& problem,
                                                                Population<G> population,
                                                                const RunOptions& options = {},
                                                                std::vector<Observer<G>> observers = {},
                                                                Keeper<P>* keeper = nullptr) {
    const Stage<P> stage(pipeline);
    check(stage, problem, population);
    Identity next = 0;
    for (const auto& individual : population)
        next = std::max(next, individual.identity + 1);
    Evaluator<P> evaluator(problem, thread_count(options.threads), options.memory_bytes, options.budget);
    Context<P> context(evaluator, options.variant, options.seed, next, std::move(observers));
    context.screen(options.screening);
    Result<G> result;
    try {
        std::optional<Population<G>> answer;
        if (keeper) {
            answer = keeper->begin(context, identity_of_run(stage, problem, options.seed, population));
            context.keep(*keeper);
        }
        result.population = answer ? std::move(*answer) : stage(std::move(population), context);
        if (keeper && !answer)
            keeper->finish(context, result.population);
    } catch (const Stopped& stop) {
        result.stopped = stop.reason;
        if (context.best())
            result.population = {*context.best()};
    }
    result.best = context.best();
    result.counters = context.counters();
    result.notes = context.notes();
    result.seconds = context.seconds();
    return result;
}

} // namespace ga
