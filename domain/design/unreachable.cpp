#include "domain/design/unreachable.hpp"

#include <algorithm>

namespace rough {

Unreachable unreachable(const DesignSetup& setup, double wanted) {
    Unreachable found{out_of_reach(setup.targets, exactly(setup).model, setup.max_pressure)};
    for (const OutOfReach& reason : found.reasons)
        found.bound = std::min(found.bound, reason.bound);
    if (found.bound >= wanted)
        found.reasons.clear();
    return found;
}

} // namespace rough
