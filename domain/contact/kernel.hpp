#pragma once

#include "domain/contact/body.hpp"
#include "domain/numerics/team.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// The length L of a line of N nodes, mm. It is N delta for the periodic kernel, otherwise (N - 1) delta;
/// delta is the node spacing. For a map L is the length along x, and N the number of nodes along x.
double profile_length(const Profile& profile, Kernel kernel);

/// The largest displacement that has a solution, mm: full contact if Body::relative_to_mean() and without a
/// hardness, otherwise infinity.
double largest_displacement(const Profile& profile, const Body& body);

/// The number of elements: L/delta for a line, the number of nodes N_x N_y for a map. The mean pressure P is
/// the sum of the node pressures divided by this number.
double elements(const Profile& profile, Kernel kernel);

/// The largest datum that is refused: (L + delta)/4, mm. H may not be positive definite then (README.md).
double datum_limit(const Profile& profile);

/// A body without units, which determines an influence matrix. Lengths along the surface are in units of the
/// node spacing delta (for a map delta_x), and pressures in units of E*.
struct UnitBody {
    Kernel kernel = Kernel::free;         ///< type of body
    double row_spacing = 0;               ///< delta_y of a map; 0: a line
    double datum = 0;                     ///< datum d, only for lines on the free half-plane
    double strip_width = 0;               ///< width W, only for the strip
    Layering layering = {};               ///< layers only for the periodic kernel
    Traction traction = Traction::normal; ///< tangential only for lines

    bool operator==(const UnitBody&) const = default; ///< member by member
    bool is_2d() const { return row_spacing > 0; }    ///< whether it is for a map
};
/// A completed body without units, for a surface of these spacings (mm; `row_spacing` is 0 for a line).
UnitBody in_units(const Body& body, double spacing, double row_spacing);

/// The first column of the influence matrix H (README.md, with sources) in units of delta/E*, N entries. H_ij
/// is the entry for the absolute offset of node j from node i along x and y. For the periodic kernel H is the
/// circulant whose eigenvalues periodic_spectrum() returns.
Eigen::VectorXd influence_column(const UnitBody& body, Extent shape, Team& team = Team::alone());
/// The first column, whose entries on the smaller grid `from` are known. Only for `free` and `strip`.
Eigen::VectorXd extended_column(const UnitBody& body, const Eigen::VectorXd& known, Extent from, Extent shape,
                                Team& team);

/// The eigenvalues of H for the periodic kernel in units of delta/E*: N_y rows of N_x/2 + 1. For a wave
/// vector of length q the eigenvalue is 2/(E* q), on a layered body times relative_compliance(). The first
/// one is for the mean pressure; it is 0 if the mean pressure does not move the surface.
Eigen::VectorXd periodic_spectrum(const UnitBody& body, Extent shape);

/// Whether contact sets only grow under load: whether H^-1 has no positive entry off its diagonal. Without
/// layers it is proven for lines, assumed for maps (README.md). With layers it is tested on this grid's H.
bool contact_sets_nest(const UnitBody& body, Extent shape);
/// Whether contact sets only grow under load, for a body and a grid in mm.
bool contact_sets_nest(const Body& body, const Grid& grid);

} // namespace rough
