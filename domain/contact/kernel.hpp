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

/// What decides an influence matrix, without units: lengths along the surface in units of the node spacing
/// delta (of an area delta_x), pressures in units of E*.
struct UnitBody {
    Kernel kernel = Kernel::free; ///< which body
    double row_spacing = 0;       ///< delta_y of an area; 0: a line
    double datum = 0;             ///< d, of a line on the free half-plane
    double strip_width = 0;       ///< W, of the strip
    Layering layering = {};       ///< of a periodic body

    bool operator==(const UnitBody&) const = default; ///< member by member
    bool is_2d() const { return row_spacing > 0; }    ///< two dimensions
};
/// A completed body, for a surface of these spacings (mm; `row_spacing` is 0 for a line).
UnitBody in_units(const Body& body, double spacing, double row_spacing);

/// First column of the influence matrix H in units of delta/E*, N entries: u_i/delta = sum_j h p_j/E* with
/// the entry h of the offset of j from i along x and y, without its signs.
/// Lines: free: Flamant, constant pressure on each element, without cancellation. strip: Love, an integral of
/// 2 asinh(W/2|x|) over the element. Areas: free: Love (1929), constant pressure on each cell; it has no
/// datum, because displacements vanish at infinity. periodic: the circulant of periodic_spectrum.
Eigen::VectorXd influence_column(const UnitBody& body, Extent shape);

/// Eigenvalues S_q of the periodic kernel in units of delta/E*: 2/(E* q), q = |wave vector|, or those of a
/// layered body (relative_compliance). N_y rows of N_x/2 + 1. The first is the mean's compliance, 0 if the
/// mean pressure does not move the surface.
Eigen::VectorXd periodic_spectrum(const UnitBody& body, Extent shape);

/// Whether contact sets only grow under load. They do if H^-1 has no entry above 0 off its diagonal: on each
/// half-space, and with layers if it holds for the circulant of this grid.
bool contact_sets_nest(const UnitBody& body, Extent shape);
/// The same of a body and grid in mm.
bool contact_sets_nest(const Body& body, const Grid& grid);

} // namespace rough
