#include "apps/commands/design/schedule.hpp"

#include "ga/base/parallel.hpp"

#include <cmath>

namespace app {

namespace {

/// Curves of the own grid that the checks of an answer take: finer grids, load steps, kernels, phases.
constexpr double curves_of_trust = 280;
/// What an answer may take longer than the start that was measured.
constexpr double longer = 2.5;
/// No part but the search gets more than this share of the whole; an area's checks get the second.
constexpr double largest_share = 0.25, share_on_area = 0.08;
/// Seconds for the report's pictures, and of the whole for what nobody measured.
constexpr double drawing = 0.6, slack = 0.02;

} // namespace

Schedule::Schedule(ga::Stopwatch clock, double limit, const rough::DesignSetup& setup,
                   const rough::Genome& start, int threads, bool pictures)
    : clock_(clock), limit_(limit) {
    if (std::isinf(limit))
        return;
    double curve = 0;
    if (setup.model.grid.is_2d()) {
        trust_ = share_on_area * limit;
    } else {
        const ga::Stopwatch one;
        similarity(setup, start);
        curve = one.seconds();
        trust_ =
            std::min(longer * curves_of_trust * curve / ga::thread_count(threads), largest_share * limit);
    }
    if (pictures && limit >= 5)
        page_ = drawing + longer * 80 * curve;
}

double Schedule::for_search() const {
    return std::isinf(limit_) ? limit_
                              : std::max(0.1 * limit_, (1 - slack) * limit_ - page_ - trust_) - spent();
}

double Schedule::for_trust() const {
    return std::isinf(limit_) ? limit_ : (1 - 0.5 * slack) * limit_ - spent() - page_;
}

} // namespace app
