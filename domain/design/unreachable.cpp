#include "domain/design/unreachable.hpp"

#include <algorithm>

namespace rough {

Unreachable unreachable(const DesignSetup& setup, std::optional<double> wanted) {
    constexpr double exact_enough = 0.999;
    Unreachable found{out_of_reach(setup.targets, exactly(setup).model, setup.max_pressure)};
    for (const OutOfReach& reason : found.reasons)
        found.bound = std::min(found.bound, reason.bound);
    if (found.bound >= wanted.value_or(exact_enough))
        found.reasons.clear();
    return found;
}

} // namespace rough
