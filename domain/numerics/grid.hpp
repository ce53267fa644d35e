#pragma once

#include <Eigen/Core>

namespace rough {

/// Counts nodes, rows and columns; signed, as Eigen counts.
using Index = Eigen::Index;

/// Nodes along x and y; node (i, j) is number j columns + i, so that x runs fastest. A line has one row.
struct Extent {
    Index columns = 0; ///< N_x
    Index rows = 1;    ///< N_y

    Index nodes() const { return columns * rows; }  ///< number of all nodes
    bool operator==(const Extent&) const = default; ///< whether both numbers are equal
};

/// The nodes at which a surface is sampled. A line has nodes at x_i = from + i * spacing(), i = 0..nodes-1. A
/// map has `rows` such lines at y_j = j * row_spacing().
struct Grid {
    Index nodes = 512;       ///< number of nodes N >= 2; for a map, N_x
    double length = 0.84942; ///< length L, mm; for a map, L_x
    bool periodic = false;   ///< whether the spacing is L/N instead of L/(N-1)
    double from = 0;         ///< x of the first node, mm
    Index rows = 1;          ///< number of rows N_y
    double width = 0;        ///< width L_y, mm; 0: a line

    bool is_2d() const { return width > 0; }       ///< whether it is the grid of a map
    Extent shape() const { return {nodes, rows}; } ///< N_x and N_y
    /// Node spacing delta along x, mm.
    double spacing() const { return length / static_cast<double>(periodic ? nodes : nodes - 1); }
    /// Node spacing delta_y along y, mm; 0 for a line. A single row is as wide as the map.
    double row_spacing() const {
        return width / static_cast<double>(periodic || rows == 1 ? rows : rows - 1);
    }
    /// Area of the patches of all nodes, mm^2; 0 for a line.
    double nominal_area() const {
        return spacing() * row_spacing() * static_cast<double>(nodes) * static_cast<double>(rows);
    }
    /// The larger of the two spacings, mm: shorter waves are not resolved along both axes.
    double widest_spacing() const { return spacing() > row_spacing() ? spacing() : row_spacing(); }
};

/// The grid with `refine` elements for each one of this grid, along x and y.
inline Grid refined(Grid grid, Index refine) {
    grid.nodes = grid.periodic ? grid.nodes * refine : (grid.nodes - 1) * refine + 1;
    if (grid.is_2d())
        grid.rows = grid.periodic || grid.rows == 1 ? grid.rows * refine : (grid.rows - 1) * refine + 1;
    return grid;
}

} // namespace rough
