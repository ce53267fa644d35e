#pragma once

#include "ga/base/stopwatch.hpp"

#include <atomic>
#include <limits>
#include <string>

namespace ga {

/// Limits of a run. If one is reached, the run stops and returns what it has found so far.
struct Budget {
    /// Maximum price of requested evaluations and derivatives, including those answered from memory, in
    /// evaluations of level 0. If a problem has one level, this is their number. It is never exceeded.
    long evaluations = std::numeric_limits<long>::max();
    double seconds = std::numeric_limits<double>::infinity(); ///< wall time, s, checked between evaluations
    const std::atomic<bool>* stop = nullptr;                  ///< true stops the run; may be null
    /// Maximum share of requested evaluations that fail, 0 to 1. Checked after each batch, from 200 on.
    double max_failures = 0.9;
};

/// The expenses of a run so far. Only `evaluations`, `remembered` and `price` depend on the size of the memory.
struct Counters {
    long requested = 0;         ///< requested evaluations and derivatives, including those answered from memory
    long evaluations = 0;       ///< calls of the problem's evaluate
    long remembered = 0;        ///< requests answered without a call
    long gradients = 0;         ///< calls of the problem's sensitivity
    long failures = 0;          ///< requested evaluations that failed; also those with a fitness that is not finite
    double requested_price = 0; ///< price of `requested`, in evaluations of level 0
    double price = 0;           ///< price of `evaluations` and `gradients`, in evaluations of level 0
};

/// Reports whether the time is over or a stop was requested.
class Watch {
  public:
    /// Starts the clock. `budget.stop` must outlive it.
    explicit Watch(const Budget& budget) : budget_(budget) {}

    double seconds() const { return clock_.seconds(); } ///< time since the object was made, s
    /// Whether the run has to stop. Any thread may call it.
    bool expired() const { return requested() || late(); }
    /// Why the run has to stop, in words.
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
