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

/// The nodes at which a surface is sampled: x_i = first_x() + i * spacing(), i = 0..nodes-1. A map has `rows`
/// such lines at y_j = first_y() + j * row_spacing(). The nodes of a line that is not periodic stand at its
/// ends, as in the paper. The nodes of a map that is not periodic stand in the middle of N_x x N_y cells,
/// which together are L_x x L_y. Nodes on the edges of a map would make the body larger than its length.
struct Grid {
    Index nodes = 512;       ///< number of nodes N >= 2; for a map, N_x
    double length = 0.84942; ///< length L, mm; for a map, L_x
    bool periodic = false;   ///< whether the surface repeats beyond its length
    double from = 0;         ///< x at which the surface begins, mm
    Index rows = 1;          ///< number of rows N_y
    double width = 0;        ///< width L_y, mm; 0: a line
    double from_y = 0;       ///< y at which a map begins, mm

    bool is_2d() const { return width > 0; }       ///< whether it is the grid of a map
    Extent shape() const { return {nodes, rows}; } ///< N_x and N_y
    /// Whether the nodes stand in the middle of cells.
    bool has_cells() const { return is_2d() && !periodic; }
    /// Node spacing delta along x, mm: L/N, or L/(N-1) for a line that is not periodic.
    double spacing() const { return length / static_cast<double>(is_2d() || periodic ? nodes : nodes - 1); }
    /// Node spacing delta_y along y, mm: L_y/N_y; 0 for a line.
    double row_spacing() const { return width / static_cast<double>(rows); }
    double first_x() const { return from + (has_cells() ? spacing() / 2 : 0); }       ///< x of the first node, mm
    double first_y() const { return from_y + (has_cells() ? row_spacing() / 2 : 0); } ///< y of the first row, mm
    /// Area of the patches of all nodes, mm^2; 0 for a line.
    double nominal_area() const {
        return spacing() * row_spacing() * static_cast<double>(nodes) * static_cast<double>(rows);
    }
    /// The larger of the two spacings, mm: shorter waves are not resolved along both axes.
    double widest_spacing() const { return spacing() > row_spacing() ? spacing() : row_spacing(); }
};

/// The grid with `refine` elements for each one of this grid, along x and y. The cells of a map are split.
inline Grid refined(Grid grid, Index refine) {
    grid.nodes = grid.is_2d() || grid.periodic ? grid.nodes * refine : (grid.nodes - 1) * refine + 1;
    if (grid.is_2d()) grid.rows *= refine;
    return grid;
}

} // namespace rough
