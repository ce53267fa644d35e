#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// K_full, MPa/mm: the stiffness with which a body resists when all `nodes` of a grid, `spacing` mm apart,
/// are in contact, K_full = (delta/L) 1' H^-1 1; infinite on a periodic half-plane, whose displacement is
/// relative to the mean plane, and 1/C0 of layers on a rigid base (mean_compliance). It is the half-plane's
/// own part of a profile's stiffness K: 1/K_i = 1/K - 1/K_full is the interface's, in which the datum
/// cancels. Found by conjugate gradients at d = L, moved to the body's datum exactly, and kept for the grids
/// asked for last, for all threads. Throws InputError on a body without a solution, NotConverged where H w is
/// not 1.
double full_contact_stiffness(Index nodes, double spacing, const Body& body);
/// The same of a surface's grid, a line's or an area's; a free area has no datum.
double full_contact_stiffness(const Profile& surface, const Body& body);

/// The mean pressure (MPa) from which on a periodic profile is in full contact, in which no node is under
/// tension: -min H^-1 Z. Throws InputError on a body without a solution.
double full_contact_load(const Profile& profile, const Body& body);

} // namespace rough
