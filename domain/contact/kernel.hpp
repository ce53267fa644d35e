#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// L in mm: (N - 1) delta on an open interval, N delta on a periodic one; of an area L_x, N_x for N.
double profile_length(const Profile& profile, Kernel kernel);

/// Nominal size in units of a node's: L/delta of a profile, the N_x N_y patches of a map. P is the sum of the
/// nodes' pressures over it.
double elements(const Profile& profile, Kernel kernel);

/// (L + delta)/4, the datum distance at or under which the free half-plane's matrix may cease to be positive
/// definite (physics: Flamant's displacement is negative beyond the datum); mm.
double datum_limit(const Profile& profile);

/// First column of the influence matrix H in units of delta/E*, N entries, for nodes one spacing apart:
/// u_i/delta = sum_j column[|i-j|] p_j/E*. `datum` and `strip_width` in units of delta.
/// free: Flamant, constant pressure on each element, without cancellation. periodic: the first column of the
/// circulant with eigenvalues 2/(E* q). strip: Love, an integral of 2 asinh(W/2|x|) over the element.
Eigen::VectorXd influence_column(Kernel kernel, Index nodes, double datum, double strip_width);

/// Eigenvalues S_k, k = 0..N/2, of the periodic kernel in units of delta/E*; S_0 = 0.
Eigen::VectorXd periodic_spectrum(Index nodes);

/// First column of an area's influence matrix in units of delta_x/E*, N entries: u_i/delta_x = sum_j h p_j/E*
/// with the entry h of the offset of j from i along x and y, either without its sign. `row_spacing` is
/// delta_y in units of delta_x. free: Love (1929), constant pressure on each cell; no datum, as displacements
/// vanish at infinity. periodic: that of the matrix with eigenvalues 2/(E* |q|).
Eigen::VectorXd area_influence_column(Kernel kernel, Extent shape, double row_spacing);

/// 2/(E* |q|) of an area's lattice in units of delta_x/E*: N_y rows of N_x/2 + 1; 0 where q = 0.
Eigen::VectorXd area_spectrum(Extent shape, double row_spacing);

} // namespace rough
