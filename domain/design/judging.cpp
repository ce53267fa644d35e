#include "domain/design/judging.hpp"

#include "domain/design/starts.hpp"
#include "domain/errors.hpp"
#include "ga/budget.hpp"
#include "ga/parallel.hpp"

#include <algorithm>

namespace rough {

namespace {

/// What judging an answer takes, in curves on the own grid by one thread, of which two at most share it; what
/// it may take longer than was foreseen.
constexpr double curves_of_judging = 60, longer_to_judge = 1.3;
constexpr int runs_to_judge = 2;
/// Of a search's time, for the first look at what a curve takes.
constexpr double share_to_look = 0.1;

} // namespace

DesignSetup ending(DesignSetup setup, double seconds, const std::atomic<bool>* stop) {
    if (setup.model.grid.is_area())
        setup.model.contact.stop = [watch = ga::Watch({std::numeric_limits<long>::max(), seconds, stop})] {
            return watch.expired();
        };
    return setup;
}

double time_of_curve(const DesignSetup& setup, const SearchOptions& options) {
    const Genome start =
        options.starts.empty() ? shaped_start(setup, ga::Stream(options.seed)) : options.starts.front();
    const DesignSetup timed = ending(setup, share_to_look * options.seconds, options.stop);
    const ga::Stopwatch clock;
    try {
        respond(timed, start, timed.model);
    } catch (const NotConverged&) {
        if (is_stopped(timed.model.contact))
            return std::numeric_limits<double>::infinity();
    } catch (const InputError&) { // the start has no curve, which takes as long to find
    }
    return clock.seconds();
}

double curves_to_judge(int threads) {
    return longer_to_judge * curves_of_judging / std::min(ga::thread_count(threads), runs_to_judge);
}

} // namespace rough
