#pragma once

#include "domain/design/inverse.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// How the approach must advance for a profile to meet the target: node k + 1 touches where the curve asked
/// for passes from the value with k nodes to that with k + 1. The target is read as rising, linear between
/// its points, continued to no load with the first two points' slope and beyond the last with the last two's.
/// A part that falls is held at the highest value before it. `nodes` is N; contact fractions count nodes over
/// it.
Advance advance_for(const Target& target, Index nodes);

} // namespace rough
