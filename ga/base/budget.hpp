#pragma once

#include "ga/base/stopwatch.hpp"

#include <atomic>
#include <limits>
#include <string>

namespace ga {

/// When a run must end, whatever its pipeline says; the best so far is its result.
struct Budget {
    long evaluations =
        std::numeric_limits<long>::max(); ///< asked for, whether paid or remembered; never exceeded
    double seconds = std::numeric_limits<double>::infinity(); ///< of wall time; looked at between evaluations
    const std::atomic<bool>* stop = nullptr; ///< becomes true when somebody asks the run to end
};

/// What a run has spent so far. All but `evaluations` and `remembered` are the same for any size of memory.
struct Counters {
    long asked = 0;       ///< individuals that came to be scored, whether their outcome was known or not
    long evaluations = 0; ///< calls of the problem's evaluate
    long remembered = 0;  ///< requests answered without a call
    long gradients = 0;   ///< calls of the problem's sensitivity
    long failures = 0;    ///< individuals marked as failed
};

/// Tells when to stop because of the time or of a request.
class Watch {
  public:
    /// Starts the clock. What `budget.stop` points to must outlive it.
    explicit Watch(const Budget& budget) : budget_(budget) {}

    double seconds() const { return clock_.seconds(); } ///< since it was made
    /// Safe to call from any thread.
    bool expired() const { return requested() || late(); }
    /// Why it expired, in words.
    std::string reason() const { return requested() ? "stop requested" : "time budget spent"; }

  private:
    bool requested() const { return budget_.stop && budget_.stop->load(std::memory_order_relaxed); }
    bool late() const {
        return budget_.seconds < std::numeric_limits<double>::infinity() && seconds() >= budget_.seconds;
    }

    Budget budget_;
    Stopwatch clock_;
};

} // namespace ga
