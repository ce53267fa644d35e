#pragma once

#include "ga/pipeline/run.hpp"

namespace ga {

/// A pipeline that hands genomes to its caller for evaluation (example in ga/README.md). It runs on a
/// separate thread, which waits while proposals are open. Observers are called on this thread. Equal outcomes
/// give the same bits as `run`. The problem's `evaluate` is never called, but its members for derivatives
/// are. Several threads may use an object.
template <Problem P>
class AskTell : Evaluator<P> {
  public:
    using Genome = typename P::Genome;   ///< genome of the problem
    using Outcome = typename P::Outcome; ///< type of the caller's answers
    /// A genome that the caller evaluates.
    struct Proposal {
        std::size_t id; ///< number of the genome in the run, from 0
        Genome genome;  ///< genome to evaluate
    };

    /// Starts the run; the parameters are those of `run_by`. Throws UsageError if the pipeline cannot work.
    AskTell(Pipeline<P> pipeline, P problem, Population<Genome> population = {}, RunOptions options = {},
            std::vector<Observer<Genome>> observers = {}, Checkpointer<P>* checkpointer = nullptr)
        : pipeline_(std::move(pipeline)), problem_(std::move(problem)), asked_to_stop_(options.budget.stop) {
        check(pipeline_, problem_, population);
        options.budget.stop = &stop_;
        thread_ = std::thread([this, population = std::move(population), options = std::move(options),
                               observers = std::move(observers), checkpointer]() mutable {
            try {
                result_ = run_by(static_cast<Evaluator<P>&>(*this), pipeline_, problem_, std::move(population), options,
                                 std::move(observers), checkpointer);
            } catch (...) {
                error_ = std::current_exception();
            }
            const std::lock_guard lock(guard_);
            done_ = true;
            changed_.notify_all();
        });
    }
    AskTell(const AskTell&) = delete;
    /// Stops the run and waits for its end.
    ~AskTell() override {
        stop();
        thread_.join();
    }

    /// The open proposals. If all are answered, waits for the next batch. Empty if the run has ended. Throws
    /// the exception that ended the run, if any.
    std::vector<Proposal> ask() {
        std::unique_lock lock(guard_);
        changed_.wait(lock, [&] { return done_ || open_ > 0; });
        if (error_) std::rethrow_exception(error_);
        std::vector<Proposal> proposals;
        for (std::size_t i = 0; i < calls_.size(); ++i)
            if (std::holds_alternative<Pending>(*calls_[i].answer))
                proposals.push_back({first_ + i, *calls_[i].genome});
        return proposals;
    }
    /// The level of evaluation of an open proposal; level 0 for another.
    Level level_of(std::size_t id) {
        const std::lock_guard lock(guard_);
        return id >= first_ && id - first_ < calls_.size() ? calls_[id - first_].level : Level{};
    }
    /// The generation at an open proposal (see EvaluationCall); empty for another.
    std::vector<std::size_t> generation_of(std::size_t id) {
        const std::lock_guard lock(guard_);
        if (id < first_ || id - first_ >= calls_.size()) return {};
        const auto generation = calls_[id - first_].generation;
        return {generation.begin(), generation.end()};
    }
    /// Answers an open proposal. Throws UsageError if the proposal is not open. A stopped run ignores answers.
    void tell(std::size_t id, Outcome outcome) { answer(id, std::move(outcome)); }
    /// Marks the evaluation of a proposal as failed, with the reason.
    void fail(std::size_t id, std::string why) { answer(id, reason(std::move(why))); }

    /// Ends the run with its current population; open proposals need no answer.
    void stop() {
        const std::lock_guard lock(guard_);
        stop_ = true;
        changed_.notify_all();
    }
    /// The run's result. Stops the run if it has not ended. Throws the exception that ended the run, if any.
    Result<Genome> result() {
        stop();
        std::unique_lock lock(guard_);
        changed_.wait(lock, [&] { return done_; });
        if (error_) std::rethrow_exception(error_);
        return result_;
    }

  private:
    /// Passes the calls to the caller as proposals. Waits until they are answered or the run must end.
    void outcomes(const P&, std::span<EvaluationCall<P>> calls, const Watch& watch) override {
        using namespace std::chrono_literals;
        std::unique_lock lock(guard_);
        calls_ = calls;
        open_ = calls.size();
        changed_.notify_all();
        while (open_ > 0 && !stop_ && !watch.expired()) {
            changed_.wait_for(lock, 20ms);
            if (asked_to_stop_ && asked_to_stop_->load()) stop_ = true;
        }
        first_ += calls.size();
        calls_ = {};
        open_ = 0;
    }

    void answer(std::size_t id, Evaluation<Outcome> evaluation) {
        const std::lock_guard lock(guard_);
        if (stop_ || done_) return;
        if (id < first_ || id - first_ >= calls_.size() ||
            !std::holds_alternative<Pending>(*calls_[id - first_].answer))
            throw UsageError("proposal " + std::to_string(id) + " is not open; answer one that ask returned");
        *calls_[id - first_].answer = std::move(evaluation);
        if (--open_ == 0) changed_.notify_all();
    }

    Pipeline<P> pipeline_;
    P problem_;
    const std::atomic<bool>* asked_to_stop_;
    std::atomic<bool> stop_ = false;
    std::mutex guard_;
    std::condition_variable changed_;
    std::span<EvaluationCall<P>> calls_;
    std::size_t first_ = 0, open_ = 0; ///< id of the first call; number of unanswered calls
    bool done_ = false;
    Result<Genome> result_;
    std::exception_ptr error_;
    std::thread thread_;
};

} // namespace ga
