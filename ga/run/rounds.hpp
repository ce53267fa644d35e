#pragma once

#include "ga/run/ledger.hpp"

#include <condition_variable>
#include <deque>
#include <semaphore>

namespace ga {

/// Runs job(i, queue) for i = 0 .. n-1, each on a separate thread, and answers their requests in rounds. When
/// every unfinished job waits for an answer, all requests go to the queue `through` together. They go in the
/// order of the jobs and from the caller's thread. So jobs with one request at a time use all threads of the
/// evaluator. Equal requests are evaluated once. The result does not depend on which job is faster.
///
/// At most `threads` jobs run at once; for 1, no member of the problem is called from two threads at once.
/// `after` is called after every round. An exception does not stop the other jobs. That of the smallest i is
/// thrown at the end. At most `room` threads exist at the same time. Rounds inside a job share this number,
/// so that nested islands do not exhaust the system's threads.
template <Problem P>
class Rounds {
  public:
    /// Runs the jobs (see the class).
    template <class Job>
    static void run(std::size_t n, EvaluationQueue<P>& through, int threads, Job job,
                    const std::function<void()>& after = {}) {
        if (n == 1) return job(std::size_t{0}, through);
        std::exception_ptr first;
        const std::size_t at_once = room();
        for (std::size_t from = 0; from < n; from += at_once) {
            try {
                if (at_once == 1)
                    job(from, through);
                else
                    Rounds(std::min(at_once, n - from), threads).go(from, through, job, after);
            } catch (...) {
                first = first ? first : std::current_exception();
            }
        }
        if (first) std::rethrow_exception(first);
    }

  private:
    /// Maximum number of jobs at the same time in rounds that this thread begins.
    static std::size_t& room() {
        thread_local std::size_t room = 64;
        return room;
    }

    class JobQueue : public EvaluationQueue<P> {
      public:
        using EvaluationQueue<P>::serve;
        void serve(std::span<EvaluationRequest<P>* const> requests) override {
            this->requests = requests;
            rounds->wait();
            answered.acquire();
            rounds->take_turn();
        }
        Rounds* rounds = nullptr;
        std::span<EvaluationRequest<P>* const> requests;
        std::binary_semaphore answered{0};
        std::exception_ptr error;
        bool done = false;
    };

    Rounds(std::size_t n, int threads) : queues_(n), busy_(n), turns_(threads) {
        for (JobQueue& queue : queues_) queue.rounds = this;
    }

    /// Marks one job as waiting or done.
    void wait() {
        const std::lock_guard lock(guard_);
        ++turns_;
        turn_is_free_.notify_one();
        if (--busy_ == 0) all_wait_.notify_one();
    }

    /// Waits until one more job may run.
    void take_turn() {
        std::unique_lock lock(guard_);
        turn_is_free_.wait(lock, [&] { return turns_ > 0; });
        --turns_;
    }

    template <class Job>
    void go(std::size_t from, EvaluationQueue<P>& through, Job& job, const std::function<void()>& after) {
        std::vector<std::thread> threads;
        const std::size_t inside = std::max<std::size_t>(1, room() / queues_.size());
        for (std::size_t i = 0; i < queues_.size(); ++i) try {
                threads.emplace_back([&, i] {
                    room() = inside;
                    take_turn();
                    JobQueue& queue = queues_[i];
                    try {
                        job(from + i, static_cast<EvaluationQueue<P>&>(queue));
                    } catch (...) {
                        queue.error = std::current_exception();
                    }
                    queue.done = true;
                    wait();
                });
            } catch (const std::system_error&) {
                queues_[i].error = std::make_exception_ptr(
                    UsageError("search " + std::to_string(from + i + 1) +
                               ": the system refuses another thread; use fewer islands or more memory"));
                queues_[i].done = true;
                take_turn();
                wait();
            }
        while (one_round(through, after)) {
        }
        for (std::thread& thread : threads) thread.join();
        for (const JobQueue& queue : queues_)
            if (queue.error) std::rethrow_exception(queue.error);
    }

    bool one_round(EvaluationQueue<P>& through, const std::function<void()>& after) {
        std::unique_lock lock(guard_);
        all_wait_.wait(lock, [&] { return busy_ == 0; });
        std::vector<EvaluationRequest<P>*> all;
        std::vector<JobQueue*> waiting;
        for (JobQueue& queue : queues_)
            if (!queue.done) {
                waiting.push_back(&queue);
                all.insert(all.end(), queue.requests.begin(), queue.requests.end());
            }
        if (waiting.empty()) return false;
        lock.unlock();
        try {
            through.serve(std::span<EvaluationRequest<P>* const>(all));
            if (after) after();
        } catch (...) {
            for (EvaluationRequest<P>* request : all) request->error = std::current_exception();
        }
        lock.lock();
        busy_ = waiting.size();
        lock.unlock();
        for (JobQueue* queue : waiting) queue->answered.release();
        return true;
    }

    std::deque<JobQueue> queues_;
    std::mutex guard_;
    std::condition_variable all_wait_, turn_is_free_;
    std::size_t busy_;
    int turns_; ///< number of further jobs that may run
};

} // namespace ga
