#pragma once

#include "domain/mwm/waves.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// Z(x_i) of Eq. 1: the sum of all chromosomes, each one cosine.
Profile sample(const Genome& genome, const Grid& grid);

/// Z(L) - Z(0), mm: by how much a genome jumps where it is continued with the period L, `length` in mm. 0,
/// but for rounding, where every wave's length divides L.
double jump_at_ends(const Genome& genome, double length);

/// Whether the sampled profile's height range is rounding alone: under 1e-12 of its amplitudes' sum.
bool is_flat(const Profile& sampled, const Genome& genome);

/// cos(k x_i) and sin(k x_i) of each chromosome's wave, N x 2 (number of waves): columns 2c and 2c+1.
Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid);

/// Pulls derivatives with respect to heights back to genes.
/// `height_gradient` is rows x N, each row a linear functional of heights that is blind to a constant
/// (contact never sees one, and the offsets of Eq. 1 are left out on that ground); the result is rows x
/// genes, in the order of genes(genome). The scale is held fixed.
Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid);

} // namespace rough
