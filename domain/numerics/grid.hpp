#pragma once

#include <Eigen/Core>

namespace rough {

/// Counts nodes, rows and columns; signed, as Eigen counts.
using Index = Eigen::Index;

/// Where a profile is sampled: x_i = from + i * spacing, i = 0..nodes-1.
struct Grid {
    Index nodes = 512;       ///< N >= 2
    double length = 0.84942; ///< L, mm
    bool wraps = false;      ///< periodic: spacing L/N in place of L/(N-1)
    double from = 0;         ///< x of the first node, mm

    double spacing() const { return length / static_cast<double>(wraps ? nodes : nodes - 1); } ///< delta, mm
};

/// The grid of `refine` elements for each of this one.
inline Grid refined(Grid grid, Index refine) {
    grid.nodes = grid.wraps ? grid.nodes * refine : (grid.nodes - 1) * refine + 1;
    return grid;
}

} // namespace rough
