#pragma once

#include "domain/numerics/grid.hpp"

#include <algorithm>
#include <vector>

namespace rough {

/// A sampled surface. A line has heights Z_i at x_i = i * spacing, i = 0..N-1. A map has its heights row
/// after row, at y_j = j * row_spacing. Lengths in mm.
struct Profile {
    Eigen::VectorXd heights; ///< N heights, mm
    double spacing = 0;      ///< delta, mm; L/(N-1) on an open interval, L/N on a periodic one
    Index rows = 1;          ///< N_y; N is a multiple of it
    double row_spacing = 0;  ///< delta_y, mm; 0: a line

    Index nodes() const { return heights.size(); }                 ///< N
    bool is_2d() const { return row_spacing > 0; }                 ///< two dimensions
    Extent shape() const { return {heights.size() / rows, rows}; } ///< N_x, N_y
};

/// The profile of these heights at nodes `spacing` apart; mm.
inline Profile profile_of(const std::vector<double>& heights, double spacing) {
    return {Eigen::Map<const Eigen::VectorXd>(heights.data(), static_cast<Index>(heights.size())), spacing};
}

/// Difference of two surfaces on equal grids: 1 minus the larger of two correlation coefficients of the
/// heights. For the second one, one sequence is reversed. The result is from 0 to 2, and 0 if one surface is
/// flat.
inline double difference(const Profile& left, const Profile& right) {
    const Eigen::VectorXd a = left.heights.array() - left.heights.mean(),
                          b = right.heights.array() - right.heights.mean();
    const double both = a.norm() * b.norm();
    return both > 0 ? 1 - std::max(a.dot(b), a.dot(b.reverse())) / both : 0;
}
constexpr double different = 0.05; ///< lowest difference() at which two designs count as different

} // namespace rough
