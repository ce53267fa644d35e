#pragma once

#include "domain/mwm/waves.hpp"
#include "domain/profile.hpp"

namespace rough {

/// Where a profile is sampled: x_i = from + i * spacing, i = 0..nodes-1.
struct Grid {
    Index nodes = 512;       ///< N >= 2
    double length = 0.84942; ///< L, mm
    bool wraps = false;      ///< periodic: spacing L/N in place of L/(N-1)
    double from = 0;         ///< x of the first node, mm

    double spacing() const { return length / static_cast<double>(wraps ? nodes : nodes - 1); } ///< delta, mm
};

/// The grid of `refine` elements for each of this one.
Grid refined(const Grid& grid, Index refine);

/// Z(x_i) of Eq. 1: the sum of all chromosomes, each one cosine.
Profile sample(const Genome& genome, const Grid& grid);

/// cos(k x_i) and sin(k x_i) of each chromosome's wave, N x 2 (number of waves): columns 2c and 2c+1.
Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid);

/// Pulls derivatives with respect to heights back to genes.
/// `height_gradient` is rows x N, each row a linear functional of heights that is blind to a constant
/// (contact never sees one, and the offsets of Eq. 1 are left out on that ground); the result is rows x
/// genes, in the order of genes(genome). The scale is held fixed.
Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid);

} // namespace rough
