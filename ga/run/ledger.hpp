#pragma once

#include "ga/run/evaluator.hpp"

#include <map>

namespace ga {

/// The individuals of a problem.
template <Problem P>
using PopulationOf = Population<typename P::Genome>;

/// Whether a request to stop is heeded at once or after the questions in hand.
enum class Patience { none, finish };

/// Questions that are answered together: outcomes of genomes, and derivatives.
template <Problem P>
struct EvaluationRequest {
    using Genome = typename P::Genome;   ///< of the problem
    using Outcome = typename P::Outcome; ///< of the problem

    /// One genome's outcome.
    struct Question {
        const Genome* genome;                        ///< must outlive the answer
        bool counts = true;                          ///< against the budget
        std::uint64_t replicate = 0;                 ///< of a noisy evaluation
        Fingerprint print = {};                      ///< set by the door
        const Evaluation<Outcome>* answer = nullptr; ///< set by the door; unanswered where the run had to end
    };

    std::vector<Question> questions;    ///< in an order that decides what is paid first
    std::vector<Slope<P>*> slopes;      ///< derivatives
    Patience patience = Patience::none; ///< of the stop
    std::function<void()> use = {}; ///< reads the answers, which stand until it returns; on the door's thread
    bool spent = false;             ///< set by the door: the budget had no room for all of it
    std::exception_ptr error = {};  ///< set by the door: Stopped, NothingLeft, or what `use` threw
};

/// Where everything that is paid for is asked. The ledger is one; a block that works on threads of its own
/// puts another before it.
template <Problem P>
class EvaluationQueue {
  public:
    virtual ~EvaluationQueue() = default;
    /// Answers inquiries together, in their order.
    virtual void serve(std::span<EvaluationRequest<P>* const> inquiries) = 0;
    /// Answers one, and throws what stands against it.
    void serve(EvaluationRequest<P>& inquiry) {
        EvaluationRequest<P>* const one[] = {&inquiry};
        serve(std::span<EvaluationRequest<P>* const>(one));
        if (inquiry.error)
            std::rethrow_exception(std::exchange(inquiry.error, nullptr));
    }
};

/// The engine's books, in front of an evaluator: what is remembered is never asked again, budgets are kept to
/// the call, failures are counted. Questions are answered in their order, so the number of threads decides
/// nothing.
template <Problem P>
class Ledger : public EvaluationQueue<P> {
  public:
    using Genome = typename P::Genome;   ///< of the problem
    using Outcome = typename P::Outcome; ///< of its evaluations
    using EvaluationQueue<P>::serve;

    /// The problem, the evaluator and the budget must outlive it. `memory_bytes` bounds what is remembered,
    /// not the result.
    Ledger(const P& problem, Evaluator<P>& evaluator, std::size_t memory_bytes, const Budget& budget)
        : problem_(problem), evaluator_(evaluator), budget_(budget), watch_(budget), memory_(memory_bytes) {}

    void serve(std::span<EvaluationRequest<P>* const> inquiries) override {
        calls_.clear();
        slopes_.clear();
        for (EvaluationRequest<P>* inquiry : inquiries)
            look_up(*inquiry);
        const bool patient =
            std::any_of(inquiries.begin(), inquiries.end(),
                        [](const EvaluationRequest<P>* each) { return each->patience == Patience::finish; });
        evaluate(patient);
        const bool cut_short = book();
        for (EvaluationRequest<P>* inquiry : inquiries) {
            answer(*inquiry, cut_short);
        }
    }

    /// Whether the budget has no room for more evaluations than these.
    bool spent(long evaluations) const { return budget_.evaluations - counters.asked <= evaluations; }

    const P& problem() const { return problem_; }          ///< what is evaluated
    Evaluator<P>& evaluator() const { return evaluator_; } ///< who makes the calls
    const Budget& budget() const { return budget_; }       ///< what may be paid
    const Watch& watch() const { return watch_; }          ///< since the ledger was made
    /// The budget of a ledger that goes on from this one's counters.
    Budget left() const { return {budget_.evaluations, budget_.seconds - watch_.seconds(), budget_.stop}; }

    Counters counters; ///< what was paid

    /// Tells a ledger whether an evaluation succeeded before it was made, and the largest outcome then.
    void resume(bool succeeded, std::size_t heaviest) {
        succeeded_ |= succeeded;
        heaviest_ = std::max(heaviest_, heaviest);
    }
    /// Takes note of what an evaluation was worth.
    void note(const Fitness& fitness) {
        succeeded_ |= !fitness.has_failed();
        if (!first_failure_ && fitness.has_failed())
            first_failure_ = reason(fitness.reason());
    }

    /// Keeps the memory to its bound. Called between two stages only: a stage that is interrupted is
    /// repeated, and what it has paid for is told from what was known before it.
    void forget_old() { memory_.forget_old(heaviest_ + bookkeeping); }
    std::size_t heaviest() const { return heaviest_; } ///< bytes of the largest outcome or reason so far

    /// Throws NothingLeft where all that was evaluated failed.
    void expect_success() const {
        if (!succeeded_ && first_failure_)
            throw NothingLeft("every one of " + std::to_string(counters.evaluations) +
                              " evaluations failed; the first: " + *first_failure_);
    }

    const Memory<Outcome>& memory() const { return memory_; } ///< outcomes that are known
    Memory<Outcome>& memory() { return memory_; }             ///< the same, to be restored from a checkpoint
    /// Hands in an evaluation that was paid for in a stage whose counts were lost: it counts as paid when it
    /// is asked for.
    void prepay(const Fingerprint& print, Evaluation<Outcome> evaluation) {
        prepaid_.at(print) = std::move(evaluation);
    }

  private:
    static constexpr std::size_t bookkeeping =
        sizeof(Evaluation<Outcome>) + sizeof(Fingerprint) + 5 * sizeof(void*);

    /// Counts the questions, and puts those whose answer is not known among the calls.
    void look_up(EvaluationRequest<P>& inquiry) {
        std::size_t within = 0;
        const auto pay = [&] {
            inquiry.spent |= counters.asked >= budget_.evaluations;
            counters.asked += inquiry.spent ? 0 : 1;
            return !inquiry.spent;
        };
        inquiry.spent = false;
        for (auto& question : inquiry.questions) {
            if (question.counts && !pay())
                break;
            question.print = identify(problem_, *question.genome);
            if (question.replicate > 0)
                question.print = {fold(question.print.high, question.replicate),
                                  fold(question.print.low, question.replicate)};
            memory_.prefetch(question.print);
            ++within;
        }
        for (std::size_t i = 0; i < within; ++i) {
            auto& question = inquiry.questions[i];
            Evaluation<Outcome>& place = memory_.at(question.print);
            question.answer = &place;
            auto* const pending = std::get_if<Pending>(&place);
            if (!pending || pending->queued) {
                ++counters.remembered;
            } else if (!take_prepaid(question.print, place)) {
                pending->queued = true;
                calls_.push_back({question.genome, &place, question.replicate});
            }
        }
        for (Slope<P>* slope : inquiry.slopes) {
            if (!pay())
                break;
            ++counters.gradients;
            slopes_.push_back(slope);
        }
    }

    void evaluate(bool patient) {
        static const Budget endless;
        static const Watch never(endless);
        if (!calls_.empty())
            evaluator_.outcomes(problem_, calls_, patient ? never : watch_);
        if (!slopes_.empty())
            evaluator_.slopes(problem_, slopes_, watch_);
    }

    /// Counts what was evaluated, forgets what was not; true when something was not.
    bool book() {
        bool interrupted = false;
        for (const Call<P>& call : calls_)
            if (Pending* pending = std::get_if<Pending>(call.answer)) {
                if (pending->why && !stop_reason_)
                    stop_reason_ = *pending->why;
                *pending = Pending{};
                interrupted = true;
            } else {
                count(*call.answer);
            }
        return interrupted;
    }

    void answer(EvaluationRequest<P>& inquiry, bool cut_short) {
        const bool open =
            cut_short &&
            std::any_of(inquiry.questions.begin(), inquiry.questions.end(), [](const auto& question) {
                return question.answer && std::holds_alternative<Pending>(*question.answer);
            });
        try {
            if (inquiry.use)
                inquiry.use();
            if (open)
                throw Stopped{stop_reason_.value_or(watch_.reason())};
            if (inquiry.spent)
                throw Stopped{"evaluation budget spent"};
            if (counters.asked > 1) // a lone start may fail
                expect_success();
        } catch (...) {
            inquiry.error = std::current_exception();
        }
    }

    bool take_prepaid(const Fingerprint& print, Evaluation<Outcome>& place) {
        Evaluation<Outcome>* paid = prepaid_.size() > 0 ? prepaid_.find(print) : nullptr;
        if (!paid || std::holds_alternative<Pending>(*paid))
            return false;
        place = std::exchange(*paid, Pending{});
        count(place);
        return true;
    }
    void count(const Evaluation<Outcome>& evaluation) {
        ++counters.evaluations;
        if (const Outcome* outcome = std::get_if<Outcome>(&evaluation)) {
            heaviest_ = std::max(heaviest_, weight(*outcome));
        } else {
            heaviest_ = std::max(heaviest_, std::get<Reason>(evaluation)->size());
        }
    }
    std::size_t weight(const Outcome& outcome) const {
        if constexpr (Weighed<P>)
            return problem_.bytes(outcome);
        else if constexpr (std::ranges::sized_range<Outcome>)
            return std::ranges::size(outcome) * sizeof(std::ranges::range_value_t<Outcome>);
        else
            return 0;
    }

    const P& problem_;
    Evaluator<P>& evaluator_;
    Budget budget_;
    Watch watch_;
    Memory<Outcome> memory_;
    Table<Evaluation<Outcome>> prepaid_;
    std::vector<Call<P>> calls_;
    std::vector<Slope<P>*> slopes_;
    std::size_t heaviest_ = 0;
    bool succeeded_ = false;
    std::optional<std::string> stop_reason_; ///< what the problem threw Stopped with
    Reason first_failure_;
};

/// The fitness an objective reads from an evaluation; failed when there is none or it is not finite.
template <Problem P>
Fitness fitness_of(const P& problem, const Evaluation<typename P::Outcome>& evaluation,
                   const Objective<typename P::Outcome>& objective, Name name) {
    if (const Reason* why = std::get_if<Reason>(&evaluation))
        return Fitness::failed(name, *why);
    const auto& outcome = std::get<typename P::Outcome>(evaluation);
    try {
        const double value = objective.fitness(outcome);
        if (!std::isfinite(value))
            return Fitness::failed(name,
                                   reason("fitness " + objective.name + " is " + std::to_string(value)));
        const Fitness fitness(name, value, objective.minimise);
        if constexpr (!Constrained<P>) {
            return fitness;
        } else {
            std::vector<double> violations = violations_of(problem, outcome);
            for (const double each : violations)
                if (!std::isfinite(each))
                    return Fitness::failed(name, reason("the constraints' violation is not finite"));
            return fitness.constrained(std::move(violations));
        }
    } catch (...) {
        return Fitness::failed(name, reason_caught());
    }
}

} // namespace ga
