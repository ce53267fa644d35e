#pragma once

#include "ga/pipeline/run.hpp"
#include "ga/pipeline/score.hpp"

namespace ga {

/// A steady-state search that never waits for the slowest evaluation (asynchronous master and workers). Each
/// question is a child of the individuals known at that time, and each answer is used as soon as it arrives.
///
///     SteadyState<P> search(sample(40), tournament(2, 1) | mutate(0.1), plus(), problem);
///     search.ask();              // a question for each worker, at any time
///     search.tell(id, outcome);  // in any order
///     search.result();
///
/// The order of questions and answers affects the result, so it is logged. Replaying the log with the same
/// outcomes gives the same bits. Only one thread may use an object; run_steady() uses several threads.
template <Problem P>
class SteadyState {
  public:
    using Genome = typename P::Genome;     ///< genome of the problem
    using Outcome = typename P::Outcome;   ///< type of the caller's answers
    using Proposal = ga::Proposal<Genome>; ///< genome to evaluate, with its number

    /// A question or its answer, in the log.
    struct Event {
        std::size_t id;          ///< number of the question
        bool is_question = true; ///< whether it is a question; otherwise it is an answer
        Reason failure = {};     ///< why the evaluation failed, if it did
    };

    /// Prepares a search. `start` makes the first population, whose size is kept. `breed` makes unscored
    /// children of the known individuals. `replace` makes the next population from one scored child and the
    /// current population, which is its generation's start (`plus`, `steady`, `crowding`). Individuals are
    /// scored under the problem's first objective. The time budget begins here. Throws UsageError if a stage
    /// cannot work.
    SteadyState(Pipeline<P> start, Pipeline<P> breed, Pipeline<P> replace, P problem, RunOptions options = {})
        : problem_(std::move(problem)), breed_(std::move(breed)), replace_(Pipeline<P>(score()) | replace),
          ledger_(problem_, evaluator_, options.memory_bytes, options.budget),
          context_(ledger_, StagePosition<Genome>(options.variant, options.seed), 0,
                   options.population_bytes) {
        check(start | score(), problem_, {});
        CheckState known = known_of(problem_);
        known.scored = known.start_scored = known.objectives.front();
        known.in_generation = true;
        breed_.check(known);
        replace_.check(known);
        replace_.check_end(known);
        context_.state.loops.push_back(&states_);
        for (auto& individual : start({}, context_))
            ready_.push_back(std::move(individual));
        size_ = ready_.size();
    }
    SteadyState(const SteadyState&) = delete;

    /// The next question. A child with a known outcome is used at once and not asked. Returns nothing if no
    /// individual is known yet, or if the open questions use up the budget. Throws NothingLeft if `breed`
    /// does not make a new genome.
    std::optional<Proposal> ask() {
        for (int known = 0;;) {
            if (ledger_.watch().expired() || ledger_.spent(static_cast<long>(open_.size())) || !breed())
                return std::nullopt;
            Individual<Genome> next = std::move(ready_.front());
            ready_.pop_front();
            if (ledger_.memory.find(identify(problem_, next.genome)) && known++ < max_vain) {
                work_in(std::move(next));
                continue;
            }
            log_.push_back({asked_});
            Proposal question{asked_++, next.genome};
            open_.emplace(question.id, std::move(next));
            return question;
        }
    }
    /// Uses an answer. Throws UsageError if the question is not open.
    void tell(std::size_t id, Outcome outcome) { answer({id, false}, std::move(outcome)); }
    /// Marks the evaluation of a question as failed, with the reason.
    void fail(std::size_t id, std::string why) {
        const Reason failure = reason(std::move(why));
        answer({id, false, failure}, failure);
    }

    std::size_t open() const { return open_.size(); }          ///< number of open questions
    const std::vector<Event>& log() const { return log_; }     ///< questions and answers, in order
    bool stopped() const { return ledger_.watch().expired(); } ///< whether the run has to end

    /// Repeats the steps of a log, with outcomes from the problem's `evaluate`.
    void replay(const std::vector<Event>& log) {
        std::map<std::size_t, Genome> open;
        for (const Event& event : log)
            if (event.is_question) {
                auto question = ask();
                if (!question || question->id != event.id)
                    throw UsageError("the log asks question " + std::to_string(event.id) +
                                     ", which this search does not; give the log of the same search");
                open.emplace(event.id, std::move(question->genome));
            } else if (event.failure) {
                fail(event.id, *event.failure);
            } else {
                tell(event.id, problem_.evaluate(open.at(event.id)));
            }
    }

    /// The current result: the population, best first, without open questions.
    Result<Genome> result() const {
        Result<Genome> result;
        result.population = best_of(population_, all_individuals);
        result.front = front_of(result.population);
        result.best = context_.best();
        result.counters = ledger_.counters;
        result.notes = context_.state.notes;
        result.seconds = ledger_.watch().seconds();
        if (stopped())
            result.stopped = ledger_.watch().reason();
        return result;
    }

  private:
    static constexpr int max_vain = 1000; ///< maximum number of known or unchanged children in succession

    /// Whether there is a child to evaluate; makes one if needed.
    bool breed() {
        for (int vain = 0; ready_.empty(); ++vain) {
            if (population_.empty())
                return false;
            if (vain == max_vain)
                throw NothingLeft("breeding made no new individual; add cross or mutate to it");
            const typename Context<P>::Round round(context_.position, bred_++, &population_);
            for (auto& child : breed_(population_, context_))
                if (!child.fitness.known())
                    ready_.push_back(std::move(child));
        }
        return true;
    }
    void answer(const Event& event, Evaluation<Outcome> evaluation) {
        const auto question = open_.find(event.id);
        if (question == open_.end())
            throw UsageError("question " + std::to_string(event.id) +
                             " is not open; answer one that ask returned");
        ledger_.prepay(identify(problem_, question->second.genome), std::move(evaluation));
        Individual<Genome> individual = std::move(question->second);
        open_.erase(question);
        log_.push_back(event);
        work_in(std::move(individual));
    }
    void work_in(Individual<Genome> individual) {
        Population<Genome> child;
        child.push_back(std::move(individual));
        const typename Context<P>::Scope scope(context_.position, Name("told"), 0);
        const typename Context<P>::Round round(context_.position, told_++, &population_);
        if (population_.size() < size_) {
            context_.score(child, "", StopMode::after_request);
            population_.push_back(std::move(child.front()));
        } else {
            population_ = replace_(std::move(child), context_);
        }
        ledger_.forget_old();
    }

    P problem_;
    Serial<P> evaluator_; ///< never called, because answers are prepaid
    Pipeline<P> breed_, replace_;
    Ledger<P> ledger_;
    Context<P> context_;
    Frame<Genome> states_;
    std::deque<Individual<Genome>> ready_;           ///< children that wait to be asked
    std::map<std::size_t, Individual<Genome>> open_; ///< questions without an answer, by id
    Population<Genome> population_;
    std::size_t size_ = 0, bred_ = 0, asked_ = 0, told_ = 0;
    std::vector<Event> log_;
};

/// Runs the search on several threads until the budget is spent. Each thread asks, evaluates and tells.
template <Problem P>
void run_steady(SteadyState<P>& search, const P& problem, int threads = 0) {
    std::mutex guard;
    std::condition_variable told;
    std::exception_ptr error;
    const auto work = [&] {
        std::unique_lock lock(guard);
        try {
            while (!error) {
                const auto question = search.ask();
                if (!question && search.open() == 0)
                    break;
                if (!question) { // the budget is spent, or no individual is known yet
                    told.wait(lock);
                    continue;
                }
                lock.unlock();
                Evaluation<typename P::Outcome> found = evaluated(problem, question->genome);
                lock.lock();
                if (auto* outcome = std::get_if<typename P::Outcome>(&found))
                    search.tell(question->id, std::move(*outcome));
                else if (const auto* why = std::get_if<Reason>(&found))
                    search.fail(question->id, **why);
                else
                    throw Stopped{*std::get<Pending>(found).why};
                told.notify_all();
            }
        } catch (...) {
            error = error ? error : std::current_exception();
        }
        told.notify_all();
    };
    std::vector<std::thread> workers;
    for (int i = 1; i < thread_count(threads); ++i)
        workers.emplace_back(work);
    work();
    for (auto& worker : workers)
        worker.join();
    if (error)
        std::rethrow_exception(error);
}

} // namespace ga
