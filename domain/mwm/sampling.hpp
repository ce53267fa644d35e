#pragma once

#include "domain/mwm/waves.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// Z(x_i) of Eq. 1: the sum of all chromosomes, each one cosine. On a map ridge m of M is a cosine with
/// the wave vector k_n (cos, sin)(pi (m-1)/M) (Ausloos & Berman 1985, Proc. R. Soc. A 400, 331). On a
/// periodic map it is the nearest wave vector that fits the map (plane_waves).
Profile sample(const Genome& genome, const Grid& grid);

/// Z(L) - Z(0), mm: the jump of a genome that is continued with the period L, `length` in mm. It is 0,
/// except for rounding, if every wavelength divides L.
double jump_at_ends(const Genome& genome, double length);

/// Whether the sampled profile's height range is only rounding: under 1e-12 of its amplitudes' sum.
bool is_flat(const Profile& sampled, const Genome& genome);

/// cos(k x_i) and sin(k x_i) of each chromosome's wave, N x 2 (number of waves): columns 2c and 2c+1.
Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid);

/// One ridge of a chromosome on a map: -amplitude cos(k_x x + k_y y + phase), and a constant.
struct PlaneWave {
    double amplitude;    ///< G_n, mm, of the sign of A, scale included
    double k_x;          ///< wavenumber along x, 1/mm
    double k_y;          ///< wavenumber along y, 1/mm
    double phase;        ///< phi, rad
    double moved = 0;    ///< distance that the wave vector was moved to fit a periodic grid, over its length
    bool fitted = false; ///< whether the grid is periodic, so that the wave vector does not follow the genes
};
/// All ridges of a genome on a grid, in the order of its phases. On a periodic grid wave vectors are the
/// nearest ones of the lattice 2 pi (i/L_x, j/L_y), other than zero.
std::vector<PlaneWave> plane_waves(const Genome& genome, const Grid& grid);

/// The waves' sum at a grid's nodes, row after row, mm, without the constants that Eq. 1 adds. Only the
/// wavenumbers along x count on a line.
Eigen::VectorXd sampled(const std::vector<PlaneWave>& waves, const Grid& grid);

/// Converts derivatives with respect to heights into derivatives with respect to genes. `height_gradient` is
/// rows x N. Each row is a linear functional of heights. A constant added to all heights does not change it,
/// so the offsets of Eq. 1 are omitted. The result is rows x genes, in the order of genes(genome), at fixed
/// scale. A wave vector that was fitted to the grid is taken as fixed.
Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid);

} // namespace rough
