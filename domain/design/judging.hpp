#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// The most of an area's search, as a share of its time, that judging its answers may take.
constexpr double most_for_judging = 0.75;

/// An area's set-up whose contact solutions end after so many seconds from now, or when `stop` asks for it
/// (ContactOptions::stop): a curve may take long there. A line's as it is given.
DesignSetup ending(DesignSetup setup, double seconds, const std::atomic<bool>* stop);

/// Seconds that a curve on an area's own grid takes, as one of a start tells; infinite where that is more
/// than a tenth of the options' seconds.
double time_of_curve(const DesignSetup& setup, const SearchOptions& options);

/// What judging an area's answer takes on so many threads, in the time of such a curve, with some to spare.
double curves_to_judge(int threads);

} // namespace rough
