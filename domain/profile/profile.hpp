#pragma once

#include "domain/numerics/grid.hpp"

#include <algorithm>
#include <vector>

namespace rough {

/// A sampled surface: a line or a map. A line has heights Z_i at x_i = i * spacing, i = 0..N-1. A map has its
/// heights row after row, at y_j = j * row_spacing. Lengths are in mm.
struct Profile {
    Eigen::VectorXd heights; ///< heights Z_i of all N nodes, mm
    double spacing = 0;      ///< node spacing delta, mm: L/(N-1) for a line that is not periodic, otherwise L/N
    Index rows = 1;          ///< number of rows N_y, of which N is a multiple
    double row_spacing = 0;  ///< spacing delta_y of the rows, mm; 0: a line

    Index nodes() const { return heights.size(); }                 ///< number of nodes N
    bool is_2d() const { return row_spacing > 0; }                 ///< whether it is a map
    Extent shape() const { return {heights.size() / rows, rows}; } ///< N_x and N_y
};

/// The line with these heights at nodes `spacing` apart; mm.
inline Profile profile_of(const std::vector<double>& heights, double spacing) {
    return {Eigen::Map<const Eigen::VectorXd>(heights.data(), static_cast<Index>(heights.size())), spacing};
}

/// The grid whose nodes are the surface's. `periodic` is for the periodic kernel.
inline Grid grid_of(const Profile& surface, bool periodic = false) {
    const auto [columns, rows] = surface.shape();
    const Index parts = surface.is_2d() || periodic ? columns : columns - 1;
    return {.nodes = columns,
            .length = surface.spacing * static_cast<double>(parts),
            .periodic = periodic,
            .rows = rows,
            .width = surface.row_spacing * static_cast<double>(rows)};
}

/// The difference of two surfaces on equal grids: 1 minus the correlation coefficient of their heights. If
/// the coefficient with the reversed heights of one surface is larger, it is used. The result is from 0 to 2,
/// and 0 if one surface is flat.
inline double difference(const Profile& left, const Profile& right) {
    const Eigen::VectorXd a = left.heights.array() - left.heights.mean(),
                          b = right.heights.array() - right.heights.mean();
    const double both = a.norm() * b.norm();
    return both > 0 ? 1 - std::max(a.dot(b), a.dot(b.reverse())) / both : 0;
}
constexpr double different = 0.05; ///< lowest difference() at which two designs count as different

} // namespace rough
