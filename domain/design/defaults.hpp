#pragma once

#include "domain/design/problem.hpp"

namespace rough {

/// The bounds with lambda's, where they were left at 0, filled in: a quarter of the length (mm) to four times
/// it.
GeneBounds completed(GeneBounds bounds, double length);

/// The set-up with what was left at 0 filled in: the model, the bounds, and the shortest wave: 8 node
/// distances. Throws InputError on a model without a solution, under 16 nodes, or a shortest wave under a
/// node distance or above the longest.
DesignSetup completed(DesignSetup setup);

} // namespace rough
