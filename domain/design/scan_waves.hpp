#pragma once

#include "domain/problem/setup.hpp"

namespace rough {

/// How many waves of 2 L/k (on a grid that is periodic L/k) are no shorter than the set-up allows.
Index max_scan_waves(const DesignSetup& setup);

/// The measured profile (DesignSetup::like) as a sum of waves of 2 L/k (mm; on a grid that is periodic L/k),
/// k = 1 to `waves`, each a series of one chromosome. With as many waves as nodes it would answer like the
/// profile by construction; of fewer the sum is fitted by least squares, in which nodes that touch under the
/// targets' last load, and those where the sum would stand above the profile, weigh most: contact sees no
/// others. Throws InputError where no profile was measured.
Genome scan_waves(const DesignSetup& setup, Index waves);

} // namespace rough
