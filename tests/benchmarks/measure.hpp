#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>

namespace rough::testing {

/// Processor time of this thread, without other work on the machine.
inline double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The lowest processor time of `rounds` runs on this thread, because other work on the machine only adds to
/// it, s. Runs once if the work takes 0.3 s or longer.
inline double least_seconds(auto&& work, int rounds) {
    double least = HUGE_VAL;
    for (int k = 0; k < rounds && (k == 0 || least < 0.3); ++k) {
        const double start = processor_seconds();
        work();
        least = std::min(least, processor_seconds() - start);
    }
    return least;
}

} // namespace rough::testing
