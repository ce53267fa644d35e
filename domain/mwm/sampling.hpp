#pragma once

#include "domain/mwm/waves.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// Z(x_i) of Eq. 1: the sum of all chromosomes, each one cosine. On an area (Ausloos & Berman 1985, Proc. R.
/// Soc. A 400, 331) ridge m of M is a cosine of its own, of wave vector k_n (cos, sin)(pi (m-1)/M); where the
/// grid is periodic, of the nearest that fits it (plane_waves).
Profile sample(const Genome& genome, const Grid& grid);

/// Z(L) - Z(0), mm: by how much a genome jumps where it is continued with the period L, `length` in mm. 0,
/// but for rounding, where every wave's length divides L.
double jump_at_ends(const Genome& genome, double length);

/// Whether the sampled profile's height range is rounding alone: under 1e-12 of its amplitudes' sum.
bool is_flat(const Profile& sampled, const Genome& genome);

/// cos(k x_i) and sin(k x_i) of each chromosome's wave, N x 2 (number of waves): columns 2c and 2c+1.
Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid);

/// One ridge of a chromosome on an area: -amplitude cos(k_x x + k_y y + phase), and a constant.
struct PlaneWave {
    double amplitude; ///< G_n, mm, of the sign of A, scale included
    double k_x;       ///< wave number along x, 1/mm
    double k_y;       ///< wave number along y, 1/mm
    double phase;     ///< phi, rad
    double moved = 0; ///< how far the wave vector was moved to fit a grid that is periodic, over its length
    bool fitted =
        false; ///< whether it was moved at all, or would be for other genes: it does not follow them
};
/// All ridges of a genome in the order of its phases, as a grid takes them: where it is periodic, wave
/// vectors are the nearest of the lattice 2 pi (i/L_x, j/L_y), of those but zero.
std::vector<PlaneWave> plane_waves(const Genome& genome, const Grid& grid);

/// The waves' sum at an area's nodes without the constants that Eq. 1 adds, row after row, mm.
Eigen::VectorXd sampled(const std::vector<PlaneWave>& waves, const Grid& grid);

/// Pulls derivatives with respect to heights back to genes.
/// `height_gradient` is rows x N, each row a linear functional of heights that is blind to a constant
/// (contact never sees one, and the offsets of Eq. 1 are left out on that ground); the result is rows x
/// genes, in the order of genes(genome). The scale is held fixed. A wave vector that was fitted to the grid
/// stays where it is.
Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid);

} // namespace rough
