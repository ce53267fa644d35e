#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// One source of error of a designed surface.
struct ErrorSource {
    std::string kind;   ///< model, numerical or target
    std::string source; ///< in words
    double size = 0;    ///< largest relative change of the curve at the target's points, or the mismatch left
};

/// By how much an answer's curve moves at the first target's points when one thing at a time is changed, Eq.
/// 11 anew where it applies: the body, the grid, the load steps, the accuracy the search was allowed; and
/// what is left of the target's mismatch.
std::vector<ErrorSource> error_budget(const DesignSetup& setup, const Answer& answer);

} // namespace rough
