#pragma once

#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

/// How ranks talk with each other.
namespace app::crew {

/// What ranks tell each other.
enum Word : int {
    hello,   ///< who one is
    setting, ///< kind and setting of the chunks that follow
    chunk,   ///< id, threads, tasks
    drop,    ///< no chunk given so far is wanted
    answers, ///< id, seconds, what was thrown, answers
    roll,    ///< are you there
    alive,   ///< yes; sent now and then by one at work, too
    end,     ///< there is nothing more to do
    bye,     ///< this rank will say nothing more
    part     ///< all have said so: leave MPI together
};

/// s of silence until a rank is given up: --patience.
inline double patience = 10;

/// s of silence until rank 0 is given up: it finds out by itself, and earlier, that its MPI hangs
/// (watch.hpp).
inline double patience_with_rank_0() { return 1.5 * patience; }

/// Seconds that MPI may take to end.
inline double farewell() { return std::max(5.0, patience); }

/// Seconds between two signs of life.
inline double interval() { return std::min(0.5, patience / 5); }

/// Since when another was silent. Time in which oneself did not listen does not count: a whole run may be
/// suspended and go on.
class Silence {
  public:
    void broken() { heard_ = listened_ = ga::Stopwatch(); }
    bool too_long(double most = patience) {
        if (listened_.seconds() > patience / 2)
            broken();
        listened_ = ga::Stopwatch();
        return heard_.seconds() > most;
    }

  private:
    ga::Stopwatch heard_, listened_;
};

/// Ever longer while nothing happens: a tenth of the time waited, up to a millisecond.
class Pause {
  public:
    std::chrono::microseconds next() {
        const double most = 1000, least = 20;
        return std::chrono::microseconds(std::lround(std::clamp(1e5 * since_.seconds(), least, most)));
    }
    void begin_anew() { since_ = ga::Stopwatch(); }

  private:
    ga::Stopwatch since_;
};

/// Acts at once and then every interval() on a thread of its own, while that lasts.
template <class Act>
std::jthread now_and_then(Act act) {
    return std::jthread([act](const std::stop_token& stop) {
        std::mutex own;
        std::condition_variable_any wait;
        for (std::unique_lock lock(own); !stop.stop_requested();) {
            act();
            wait.wait_for(lock, stop, std::chrono::duration<double>(interval()), [] { return false; });
        }
    });
}

} // namespace app::crew
