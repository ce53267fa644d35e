#pragma once

#include "domain/contact/body.hpp"
#include "domain/profile/profile.hpp"
#include "domain/target/target.hpp"

#include <functional>
#include <vector>

namespace rough {

/// The profile whose nodes come into contact in a chosen order and at chosen displacements.
struct InverseProfile {
    Profile profile;             ///< highest node 0 mm
    std::vector<double> entry;   ///< displacement at which order[k] touches, mm, k = 0..N-1, none decreasing
    double last_displacement;    ///< where the load ends, mm
    double last_pressure;        ///< the mean pressure there, MPa
    Eigen::VectorXd lowest_free; ///< N, mm: where a node would just touch there
};

/// How the approach advances: stiffness[k] is dP/dDelta (MPa/mm) while order[0..k] touch, k = 0..N-1, and the
/// answer's k-th number is the displacement (mm, >= 0) over which just those nodes do; the last one is not
/// read.
using Advance = std::function<std::vector<double>(const Eigen::VectorXd& stiffness)>;

/// How the approach must advance for a profile to meet the target: node k + 1 touches where the curve asked
/// for passes from the value with k nodes to that with k + 1. The target is read as rising, linear between
/// its points, continued to no load with the first two points' slope and beyond the last with the last two's.
/// A part that falls is held at the highest value before it. `nodes` is N; contact fractions count nodes over
/// it.
Advance advance_for(const Target& target, Index nodes);

/// Solves the contact problem backwards. On a contact set A pressures grow by w = H_AA^-1 1 > 0 for each unit
/// of displacement, so any order of nodes and any advance give pressures that are never negative, and node k
/// touches when it does if its gap is Delta - u_k there; the gap of a node outside A closes all the while, as
/// a flat punch moves every other node by less than itself. So there is exactly one profile for each order,
/// and one for each rising K(P) between the stiffness of order[0] alone and that of full contact.
/// The load ends at `last_pressure` (MPa) or at `last_displacement` (mm), whichever comes first; give
/// infinity for the other. `order` holds each node once. O(N^3) work, N^2 memory: meant for up to some
/// hundred nodes.
/// Only the nodes of `surface` are read, a line's or an area's, not its heights.
InverseProfile inverse_profile(const Profile& surface, const Body& body, const std::vector<int>& order,
                               const Advance& advance, double last_pressure, double last_displacement);

/// The same with the heights of nodes that do not touch under the load moved so that the height range is
/// last_displacement: the profile reaches the last pressure at full approach, as Eq. 11 asks. A profile that
/// has no such node is returned as it is.
InverseProfile with_range_at_last(InverseProfile inverse);

/// The same of a periodic profile, whose full contact is at the mean plane: with these heights moved so that
/// last_displacement is `reach` (> 0, < 1) times the highest node's height over it.
InverseProfile with_mean_at_full_approach(InverseProfile inverse, double reach);

} // namespace rough
