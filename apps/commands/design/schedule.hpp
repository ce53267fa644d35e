#pragma once

#include "domain/problem/problem.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>

namespace app {

/// How a design shares out its wall time: the search gets what picking an answer, verifying it and drawing
/// the report leave. What these take is measured on a first start of the design itself. An area's search
/// judges its answer within its own time.
class Schedule {
  public:
    /// `limit` seconds by the clock, infinite for no limit (nothing is measured then); `start` is what the
    /// design begins with, where that is given.
    Schedule(ga::Stopwatch clock, double limit, const rough::DesignSetup& setup,
             const std::optional<rough::Genome>& start, int threads, bool pictures);

    double spent() const { return clock_.seconds(); }
    /// Seconds that a start, an answer picked on both grids and the report take without any search.
    double least() const { return picking() + page_; }
    /// Seconds from now on that the search may take.
    double for_search() const;
    /// Answers that there is time to compare on the finer grid, as SearchOptions::compared.
    std::size_t compared() const;
    /// Seconds from now on that verifying may take; what is not verified by then is left out.
    double for_trust() const;
    bool has_time_for_page() const { return spent() + page_ < limit_; }
    /// Seconds from now on that drawing the report may take, an hour where there is no limit.
    double for_drawing() const { return std::min(3600., limit_ - spent()); }

  private:
    double picking() const;

    ga::Stopwatch clock_;
    double limit_;
    int threads_;
    bool area_;
    double both_ = 0;  ///< an answer's curves on both grids
    double page_ = 0;  ///< the report
    double trust_ = 0; ///< verifying, all of it
};

} // namespace app
