#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"

namespace rough {

/// K_full, MPa/mm: the stiffness of the body when all `nodes` of a grid, `spacing` mm apart, are in contact:
/// K_full = (delta/L) 1' H^-1 1. Infinite on a periodic half-plane, whose displacement is relative to the
/// mean plane; 1/C0 of layers on a rigid base (mean_compliance).
/// It is the half-plane's part of a profile's stiffness K: 1/K_i = 1/K - 1/K_full is the interface's, in
/// which the datum cancels. Found by conjugate gradients at d = L, moved to the body's datum exactly, and
/// remembered for all threads. Throws InputError for a body without a solution, NotConverged if H w is not 1.
double full_contact_stiffness(Index nodes, double spacing, const Body& body);
/// K_full on the grid of a line or a map; a free map has no datum.
double full_contact_stiffness(const Profile& surface, const Body& body);

/// The mean pressure (MPa) at which a periodic profile reaches full contact without tension at any node: -min
/// H^-1 Z. Throws InputError for a body without a solution.
double full_contact_load(const Profile& profile, const Body& body);

} // namespace rough
