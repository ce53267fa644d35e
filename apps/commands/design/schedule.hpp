#pragma once

#include "domain/problem/problem.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>

namespace app {

/// How a design shares out its wall time: the search, which keeps back what it verifies in, gets what the
/// trust in its answer and drawing the report leave. What these take is measured on a first start of the
/// design.
class Schedule {
  public:
    /// `limit` seconds by the clock, infinite for no limit: nothing is measured then.
    Schedule(ga::Stopwatch clock, double limit, const rough::DesignSetup& setup, const rough::Genome& start,
             int threads, bool pictures);

    double spent() const { return clock_.seconds(); } ///< seconds
    /// Seconds from now on that the search may take.
    double for_search() const;
    /// Seconds from now on that further checks may take; what is not checked by then is left out.
    double for_trust() const;
    /// Whether the report can be drawn.
    bool has_time_for_page() const { return spent() + page_ < limit_; }
    /// Seconds from now on that drawing the report may take, an hour where there is no limit.
    double for_drawing() const { return std::min(3600., limit_ - spent()); }

  private:
    ga::Stopwatch clock_;
    double limit_, page_ = 0, trust_ = 0; ///< seconds
};

} // namespace app
