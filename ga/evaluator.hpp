#pragma once

#include "ga/budget.hpp"
#include "ga/memory.hpp"
#include "ga/parallel.hpp"
#include "ga/problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace ga {

/// Optional: the bytes an outcome takes in memory, where it owns more than itself.
template <class P>
concept Weighed = requires(const P& problem, const typename P::Outcome& outcome) {
    { problem.bytes(outcome) } -> std::convertible_to<std::size_t>;
};

/// Whether a request to stop is heeded at once or after the population in hand.
enum class Patience { none, finish };

/// Makes the paid calls: in parallel, each genome once, failures caught. Requests are queued and answered in
/// the population's order, so the number of threads decides nothing.
template <Problem P>
class Evaluator {
  public:
    using Genome = typename P::Genome;   ///< of the problem
    using Outcome = typename P::Outcome; ///< of its evaluations

    /// The problem and the budget must outlive it. `memory_bytes` bounds what is remembered, not the result.
    Evaluator(const P& problem, int threads, std::size_t memory_bytes, const Budget& budget)
        : problem_(problem), threads_(threads), budget_(budget), watch_(budget), memory_(memory_bytes) {}

    /// Calls use(individual, evaluation) for each individual that is wanted, in order, with its outcome or
    /// the reason it has none. Throws Stopped when a budget ends first, after what was evaluated is used;
    /// NothingLeft when no evaluation of the run has succeeded.
    template <class Wanted, class Use>
    void visit(Population<Genome>& population, Wanted wanted, Use use, Patience patience = Patience::none) {
        queue_.clear();
        fresh_.clear();
        bool spent = false;
        for (auto& individual : population) {
            if (!wanted(individual))
                continue;
            if (!individual.fitness.known()) {
                spent = counters.asked >= budget_.evaluations && patience == Patience::none;
                if (spent)
                    break;
                ++counters.asked;
            }
            queue_.push_back({&individual, identify(problem_, individual.genome), nullptr});
            memory_.prefetch(queue_.back().print);
        }
        for (Request& request : queue_) {
            Evaluation<Outcome>& place = memory_.at(request.print);
            request.place = &place;
            if (auto* pending = std::get_if<Pending>(&place); pending && !pending->queued) {
                if (prepaid_.size() > 0 && take_prepaid(request.print, place))
                    continue;
                pending->queued = true;
                fresh_.push_back({&request.individual->genome, &place});
            } else {
                ++counters.remembered;
            }
        }
        make(patience);
        for (const Request& request : queue_)
            if (!std::holds_alternative<Pending>(*request.place))
                use(*request.individual, *request.place);
        const bool interrupted = tidy();
        if (interrupted)
            throw Stopped{watch_.reason()};
        if (spent)
            throw Stopped{"evaluation budget spent"};
        if (!succeeded_ && first_failure_)
            throw NothingLeft("every one of " + std::to_string(counters.evaluations) +
                              " evaluations failed; the first: " + *first_failure_);
    }

    /// The fitness an objective reads from an evaluation; failed when there is none or it is not finite.
    static Fitness judge(const Evaluation<Outcome>& evaluation, const Objective<Outcome>& objective,
                         Name name) {
        if (const Reason* reason = std::get_if<Reason>(&evaluation))
            return Fitness::failed(name, *reason);
        try {
            const double value = objective.fitness(std::get<Outcome>(evaluation));
            if (std::isfinite(value))
                return Fitness(name, value);
            return Fitness::failed(name, std::make_shared<const std::string>("fitness " + objective.name +
                                                                             " is " + std::to_string(value)));
        } catch (const std::exception& error) {
            return Fitness::failed(name, std::make_shared<const std::string>(error.what()));
        }
    }

    /// One paid call with its failure caught; counts nothing, touches no memory, safe from any thread.
    Evaluation<Outcome> evaluate(const Genome& genome) const {
        try {
            return problem_.evaluate(genome);
        } catch (const std::exception& error) {
            return std::make_shared<const std::string>(error.what());
        } catch (...) {
            return std::make_shared<const std::string>("an exception that is no std::exception");
        }
    }

    /// Whether the budget has no room for more evaluations than these.
    bool spent(long evaluations) const { return budget_.evaluations - counters.asked <= evaluations; }

    const P& problem() const { return problem_; }    ///< what is evaluated
    int threads() const { return threads_; }         ///< that calls are spread over
    const Budget& budget() const { return budget_; } ///< what may be paid
    const Watch& watch() const { return watch_; }    ///< since the evaluator was made

    Counters counters; ///< what was paid

    /// Tells an evaluator that goes on with a run whether an evaluation of it has succeeded.
    void resume(bool succeeded) { succeeded_ = succeeded; }

    const Memory<Outcome>& memory() const { return memory_; } ///< outcomes that are known
    Memory<Outcome>& memory() { return memory_; }             ///< the same, to be restored from a checkpoint
    /// Hands in an evaluation that was paid for in a stage whose counts were lost: it counts as paid when it
    /// is asked for.
    void prepay(const Fingerprint& print, Evaluation<Outcome> evaluation) {
        prepaid_.at(print) = std::move(evaluation);
    }

    /// Puts an evaluation that was given up aside, in case another objective wants it: the last few hundred.
    void shelve(const Fingerprint& print, std::unique_ptr<Appraisal<Outcome>> work) {
        constexpr std::size_t most = 256;
        if (shelf_.size() >= most)
            shelf_.clear();
        shelf_[{print.low, print.high}] = std::move(work);
    }
    /// Takes it back; null where there is none.
    std::unique_ptr<Appraisal<Outcome>> unshelve(const Fingerprint& print) {
        const auto found = shelf_.extract({print.low, print.high});
        return found.empty() ? nullptr : std::move(found.mapped());
    }

  private:
    struct Request {
        Individual<Genome>* individual;
        Fingerprint print;
        const Evaluation<Outcome>* place;
    };
    struct Fresh {
        const Genome* genome;
        Evaluation<Outcome>* place;
    };

    /// Evaluates what is fresh. Waking threads costs microseconds, so a batch that takes less stays on this
    /// one, by the least that an evaluation took lately; that decides no result.
    void make(Patience patience) {
        const auto make_one = [&](std::size_t i) {
            if (patience == Patience::finish || !watch_.expired())
                *fresh_[i].place = evaluate(*fresh_[i].genome);
        };
        if (threads_ == 1 || fresh_.empty())
            return parallel_for(fresh_.size(), 1, make_one);
        const auto timed = [&](std::size_t i) {
            const double start = watch_.seconds();
            make_one(i);
            cost_ = std::min(watch_.seconds() - start, 1.2 * cost_);
        };
        const std::size_t alone =
            std::isinf(cost_) ? 1 : 0; // the first of all is timed before others are begun
        if (alone)
            timed(0);
        constexpr double worth_waking = 50e-6;
        const bool together = cost_ * static_cast<double>(fresh_.size()) > worth_waking;
        parallel_for(fresh_.size() - alone, together ? threads_ : 1,
                     [&](std::size_t i) { alone == 0 && i == 0 ? timed(i) : make_one(i + alone); });
    }

    bool take_prepaid(const Fingerprint& print, Evaluation<Outcome>& place) {
        Evaluation<Outcome>* paid = prepaid_.find(print);
        if (!paid || std::holds_alternative<Pending>(*paid))
            return false;
        place = std::exchange(*paid, Pending{});
        count(place);
        return true;
    }

    /// Counts what was evaluated, forgets what was not; true when something was not.
    bool tidy() {
        bool interrupted = false;
        for (const Fresh& fresh : fresh_) {
            if (std::holds_alternative<Pending>(*fresh.place)) {
                *fresh.place = Pending{};
                interrupted = true;
                continue;
            }
            count(*fresh.place);
        }
        constexpr std::size_t bookkeeping =
            sizeof(Evaluation<Outcome>) + sizeof(Fingerprint) + 4 * sizeof(void*);
        if (!interrupted)
            memory_.forget_old(heaviest_ + bookkeeping);
        return interrupted;
    }
    void count(const Evaluation<Outcome>& evaluation) {
        ++counters.evaluations;
        if (const Outcome* outcome = std::get_if<Outcome>(&evaluation)) {
            succeeded_ = true;
            heaviest_ = std::max(heaviest_, weight(*outcome));
        } else if (!first_failure_) {
            first_failure_ = std::get<Reason>(evaluation);
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
    int threads_;
    Budget budget_;
    Watch watch_;
    Memory<Outcome> memory_;
    Table<Evaluation<Outcome>> prepaid_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::unique_ptr<Appraisal<Outcome>>> shelf_;
    std::vector<Request> queue_;
    std::vector<Fresh> fresh_;
    std::size_t heaviest_ = 0;
    double cost_ = HUGE_VAL; ///< seconds an evaluation took lately
    bool succeeded_ = false;
    Reason first_failure_;
};

} // namespace ga
