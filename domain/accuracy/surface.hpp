#pragma once

#include "domain/accuracy/chromosomes.hpp"

#include <functional>

namespace rough {

/// Something with a height everywhere, to be sampled on any grid.
struct Surface {
    std::function<Profile(const Grid&)> sampled; ///< heights on a grid, mm
    double finest_feature = 0; ///< mm: on grids much coarser the surface is not to be recognised
};

/// The genome's own sum of waves.
Surface surface_of(const Genome& genome);

/// The elements around a resolved grid's nodes make up a body; `elements` equal ones over the same body,
/// their nodes in the middle. A coarse grid of nodes from end to end would be a longer body than a fine one,
/// since half an element hangs over at either end, and err by that to first order.
Grid cells(const Grid& resolved, Index elements);

} // namespace rough
