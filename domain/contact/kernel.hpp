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
/// circulant of periodic_spectrum. strip: Love, an integral of 2 asinh(W/2|x|) over the element.
Eigen::VectorXd influence_column(Kernel kernel, Index nodes, double datum, double strip_width,
                                 const Layering& layering = {});

/// Eigenvalues S_k, k = 0..N/2, of the periodic kernel in units of delta/E*: 2/(E* q), or that of a layered
/// body (relative_compliance; layers in units of delta and E*). S_0 is the mean's compliance, 0 without one.
Eigen::VectorXd periodic_spectrum(Index nodes, const Layering& layering = {});

/// First column of an area's influence matrix in units of delta_x/E*, N entries: u_i/delta_x = sum_j h p_j/E*
/// with the entry h of the offset of j from i along x and y, either without its sign. `row_spacing` is
/// delta_y in units of delta_x. free: Love (1929), constant pressure on each cell; no datum, as displacements
/// vanish at infinity. periodic: that of the matrix with the eigenvalues of area_spectrum.
Eigen::VectorXd area_influence_column(Kernel kernel, Extent shape, double row_spacing,
                                      const Layering& layering = {});

/// As periodic_spectrum for q = |wave vector|, of an area's lattice in units of delta_x/E*: N_y rows of
/// N_x/2 + 1.
Eigen::VectorXd area_spectrum(Extent shape, double row_spacing, const Layering& layering = {});

/// Whether contact sets only grow under load, as they do where H^-1 has no entry above 0 off its diagonal: on
/// each half-space; with layers if that holds of the circulant of this grid. `row_spacing` is 0 for a line,
/// layers are in units of delta and E*.
bool contact_sets_nest(Extent shape, double row_spacing, const Layering& layering);
/// The same of a body and grid in mm.
bool contact_sets_nest(const Body& body, const Grid& grid);

} // namespace rough
