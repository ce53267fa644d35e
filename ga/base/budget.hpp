#pragma once

#include "ga/base/stopwatch.hpp"

#include <atomic>
#include <limits>
#include <string>

namespace ga {

/// Limits of a run. If one is reached, the run stops and returns what it has found so far.
struct Budget {
    long evaluations = std::numeric_limits<long>::max(); ///< requested evaluations, including those answered
                                                         ///< from memory; never exceeded
    double seconds = std::numeric_limits<double>::infinity(); ///< wall time, checked between evaluations
    const std::atomic<bool>* stop = nullptr;                  ///< becomes true to stop the run; may be null
};

/// The expenses of a run so far. Only `evaluations` and `remembered` depend on the size of the memory.
struct Counters {
    long asked = 0;       ///< requested evaluations, including those answered from memory
    long evaluations = 0; ///< calls of the problem's evaluate
    long remembered = 0;  ///< requests answered without a call
    long gradients = 0;   ///< calls of the problem's sensitivity
    long failures = 0;    ///< individuals marked as failed
};

/// Reports when the time is over or a stop was requested.
class Watch {
  public:
    /// Starts the clock. `budget.stop` must outlive it.
    explicit Watch(const Budget& budget) : budget_(budget) {}

    double seconds() const { return clock_.seconds(); } ///< time since it was made
    /// Safe to call from any thread.
    bool expired() const { return requested() || late(); }
    /// Why it has expired, in words.
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
