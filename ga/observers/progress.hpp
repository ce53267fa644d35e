#pragma once

#include "ga/base/number.hpp"
#include "ga/observers/summary.hpp"

#include <cstdio>

namespace ga {

/// A run on one line: "mine/repeat.1/score.1 generation 12: best 0.9812, 1300 evaluations".
template <class G>
std::string status(const Event<G>& event) {
    std::string line = event.path;
    if (!event.generation.empty())
        line += " generation " + std::to_string(event.generation.back() + 1);
    if (const auto best = best_value(event.population)) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", *best);
        line += std::string(": best ") + text;
    }
    return line + ", " + std::to_string(event.counters.asked) + " evaluations";
}

/// Hands the status to `show`, at most once in so many seconds.
template <class G>
Observer<G> progress(std::function<void(const std::string&)> show, double interval = 0.1) {
    return [show = std::move(show), interval, next = 0.0](const Event<G>& event) mutable {
        if (event.seconds < next)
            return;
        next = event.seconds + interval;
        show(status(event));
    };
}

} // namespace ga
