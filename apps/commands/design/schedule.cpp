#include "apps/commands/design/schedule.hpp"

#include "apps/report/plot.hpp"
#include "domain/design/starts.hpp"
#include "ga/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

/// What a search's answer may take longer than the start that was measured, on a machine that may have become
/// busier since.
constexpr double longer = 2.5;
/// No part but the search gets more than this share of the whole.
constexpr double largest_share = 0.25;
/// Of the whole, for verifying an area, whose search keeps back what judging takes.
constexpr double verifying_area = 0.08;

/// Of the whole, for what nobody measured.
constexpr double slack = 0.02;

/// The mean of three tries, or of fewer that take `most` seconds.
template <class Work>
double seconds_of(double most, Work work) {
    const ga::Stopwatch clock;
    int tries = 0;
    do
        work();
    while (++tries < 3 && clock.seconds() < most);
    return clock.seconds() / tries;
}

} // namespace

Schedule::Schedule(ga::Stopwatch clock, double limit, const rough::DesignSetup& setup,
                   const std::optional<rough::Genome>& start, int threads, bool pictures)
    : clock_(clock), limit_(limit), threads_(ga::thread_count(threads)), area_(setup.model.grid.is_area()) {
    if (std::isinf(limit))
        return;
    const double look = 0.05 * limit;
    if (area_) {
        trust_ = verifying_area * limit;
    } else {
        const rough::Genome genome = start ? *start : shaped_start(setup, ga::Stream(0));
        const double coarse = seconds_of(look, [&] { similarity(setup, genome); });
        // Where there is no time to look: a direct solver's cost grows with the square.
        both_ = 16 * coarse > 0.2 * limit
                    ? 34 * coarse
                    : coarse + seconds_of(look, [&] { rough::Judge(setup).of(genome); });
        // Finer grids, more load steps and kernels take about six such answers, phases drawn anew thirty
        // curves.
        trust_ = longer * (6 * both_ + 60 * coarse) / threads_;
    }
    if (pictures && limit >= 5) {
        Plot target;
        target.series.push_back({"", setup.targets[0].x, setup.targets[0].y, Colour::text, Style::points, 2});
        page_ = 4 * seconds_of(0, [&] { draw({target}, "plot", look); }) + longer * 2 * both_;
    }
}

double Schedule::picking() const {
    // The search's last piece of work is one that may need both grids.
    return longer * both_ * (1 + std::ceil(2.0 * static_cast<double>(compared()) / threads_));
}

double Schedule::for_search() const {
    if (std::isinf(limit_))
        return limit_;
    const double rest = page_ + std::min(trust_, largest_share * limit_) + picking() + slack * limit_;
    return std::max(0.1 * limit_, limit_ - rest) - spent();
}

std::size_t Schedule::compared() const {
    return std::isinf(limit_) || 6 * longer * both_ / threads_ < 0.5 * largest_share * limit_ ? 3 : 1;
}

double Schedule::for_trust() const {
    return std::isinf(limit_) ? limit_ : limit_ - spent() - page_ - 0.5 * slack * limit_;
}

} // namespace app
