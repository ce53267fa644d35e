#pragma once

#include "domain/mwm/waves.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// The heights Z(x_i) of a genome by Eq. 1: the sum of all chromosomes, each of which is one cosine. On a map
/// each ridge is a cosine. The wave vector of ridge m of M has the length k_n and the direction pi (m-1)/M
/// from x (Ausloos & Berman 1985, Proc. R. Soc. A 400, 331). On a periodic map it is the nearest wave vector
/// that fits the map (plane_waves).
Profile sample(const Genome& genome, const Grid& grid);

/// The jump Z(L) - Z(0) of a profile that repeats with the period L, mm; L is `length`, mm. It is 0, except
/// for rounding, if every wavelength divides L.
double jump_at_ends(const Genome& genome, double length);

/// Whether a profile's height range is only rounding: below 1e-12 times the genome's sum of amplitudes.
bool is_flat(const Profile& sampled, const Genome& genome);

/// The values cos(k x_i) and sin(k x_i) of each wave: N rows, and columns 2c and 2c+1 for wave c.
Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid);

/// One ridge of a chromosome on a map: -amplitude cos(k_x x + k_y y + phase), plus a constant.
struct PlaneWave {
    double amplitude;    ///< G_n times the genome's scale, mm; negative if A is negative
    double k_x;          ///< wavenumber along x, 1/mm
    double k_y;          ///< wavenumber along y, 1/mm
    double phase;        ///< phase phi of the ridge, rad
    double moved = 0;    ///< change of the wave vector to fit the grid, divided by its length
    bool fitted = false; ///< whether the wave vector is fitted to a periodic grid (constant for derivatives)
};
/// All ridges of a genome on a grid, in the order of its phases. On a periodic grid wave vectors are the
/// nearest ones of the lattice 2 pi (i/L_x, j/L_y), except zero.
std::vector<PlaneWave> plane_waves(const Genome& genome, const Grid& grid);

/// The sum of the waves at a grid's nodes, row after row, mm, without the constants that Eq. 1 adds. On a
/// line only the wavenumbers along x are used.
Eigen::VectorXd sampled(const std::vector<PlaneWave>& waves, const Grid& grid);

/// Converts derivatives with respect to heights into derivatives with respect to genes. `height_gradient` is
/// rows x N: each row has the derivatives of one quantity. The quantity must not change if a constant is
/// added to all heights, because the offsets of Eq. 1 are omitted. The result is rows x genes, in the order
/// of genes(genome), at fixed scale. A wave vector that was fitted to the grid is treated as fixed.
Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid);

} // namespace rough
