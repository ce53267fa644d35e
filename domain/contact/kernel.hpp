#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

class Team;

/// L in mm: (N - 1) delta on an open interval, N delta on a periodic one. For a map L_x, with N_x for N.
double profile_length(const Profile& profile, Kernel kernel);

/// Nominal size in units of the size of a node: L/delta of a profile, the N_x N_y patches of a map. P is the
/// sum of the node pressures over it.
double elements(const Profile& profile, Kernel kernel);

/// (L + delta)/4 in mm, the largest datum that is refused. Up to it the free half-plane's matrix may not be
/// positive definite, because Flamant's displacement is negative beyond the datum.
double datum_limit(const Profile& profile);

/// A body without units, which determines an influence matrix. Lengths along the surface are in units of the
/// node spacing delta (for a map delta_x), and pressures in units of E*.
struct UnitBody {
    Kernel kernel = Kernel::free; ///< which body
    double row_spacing = 0;       ///< delta_y of a map; 0: a line
    double datum = 0;             ///< d, for lines on the free half-plane
    double strip_width = 0;       ///< W, strip only
    Layering layering = {};       ///< periodic only

    bool operator==(const UnitBody&) const = default; ///< member by member
    bool is_2d() const { return row_spacing > 0; }    ///< two dimensions
};
/// A completed body, for a surface of these spacings (mm; `row_spacing` is 0 for a line).
UnitBody in_units(const Body& body, double spacing, double row_spacing);

/// First column of the influence matrix H in units of delta/E*, N entries: u_i/delta = sum_j h p_j/E*. The
/// entry h is that of the absolute offset of j from i along x and y.
/// Lines: Flamant with constant pressure on each element, without cancellation (free), or Love's integral of
/// 2 asinh(W/2|x|) over the element (strip). Maps: Love (1929), constant pressure on each cell (free). It
/// has no datum, because displacements vanish at infinity. periodic: the circulant of periodic_spectrum.
Eigen::VectorXd influence_column(const UnitBody& body, Extent shape);
/// Shares the work among the threads of a team.
Eigen::VectorXd influence_column(const UnitBody& body, Extent shape, Team& team);

/// Eigenvalues S_q of the periodic kernel in units of delta/E*: 2/(E* q), q = |wave vector|, or those of a
/// layered body (relative_compliance). N_y rows of N_x/2 + 1. The first is the mean's compliance, 0 if the
/// mean pressure does not move the surface.
Eigen::VectorXd periodic_spectrum(const UnitBody& body, Extent shape);

/// Whether contact sets only grow under load. They do if H^-1 has no positive entry off its diagonal. This is
/// proven for lines on a half-space. For maps on a half-space it is taken from the continuous surface (Barber
/// 1974). With layers it is tested on the circulant of this grid.
bool contact_sets_nest(const UnitBody& body, Extent shape);
/// Whether contact sets only grow, for a body and grid in mm.
bool contact_sets_nest(const Body& body, const Grid& grid);

} // namespace rough
