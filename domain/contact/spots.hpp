#pragma once

#include "domain/numerics/grid.hpp"

#include <vector>

namespace rough {

/// Contact spots: nodes in contact that are neighbours along x or y, directly or by way of others. Returns
/// how many nodes each has, the largest first. `contact` are the nodes that touch, in any order, of a grid
/// that is its own neighbour beyond its ends where it `wraps`. On a line, its runs.
std::vector<Index> contact_spots(const std::vector<int>& contact, Extent shape, bool wraps);

} // namespace rough
