#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// L in mm: (N - 1) delta on an open interval, N delta on a periodic one.
double profile_length(const Profile& profile, Kernel kernel);

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

} // namespace rough
