#pragma once

#include "domain/target/target.hpp"

namespace rough {

/// A profile whose nodes come into contact in a chosen order and at chosen displacements.
struct InverseProfile {
    Profile profile;             ///< highest node at 0 mm
    std::vector<double> entry;   ///< displacement at which order[k] touches, mm, k = 0..N-1, not decreasing
    double last_displacement;    ///< at the end of loading, mm
    double last_pressure;        ///< mean pressure at the end of loading, MPa
    Eigen::VectorXd lowest_free; ///< N heights at which a node would just touch at the end of loading, mm
};

/// The displacements between touches of successive nodes. `stiffness[k]` is dP/dDelta (MPa/mm) while
/// order[0..k] touch, k = 0..N-1. The result's k-th number is the displacement (mm, >= 0) during which
/// exactly these nodes touch; the last number is not read.
using Advance = std::function<std::vector<double>(const Eigen::VectorXd& stiffness)>;

/// The advance for a profile that matches the target. Node k + 1 touches when the target's curve passes the
/// middle between the value for k nodes and the value for k + 1. The curve is linear between its points and
/// continued with its end slopes. From a single point it falls to half the value at 0. A part that falls is
/// replaced by the highest value before it. `nodes` is N, by which contact fractions are counted.
Advance advance_for(const Target& target, Index nodes);

/// Solves the contact problem backwards. H is the influence matrix (kernel.hpp), and H_AA its part for a
/// contact set A. On A, pressures grow by w = H_AA^-1 1 > 0 per unit of displacement. Node k touches at the
/// displacement Delta if its gap at first touch is Delta - u_k. u_k is the displacement of the body's surface
/// at node k at that moment. So there is exactly one profile for each order and advance.
///
/// Only the nodes of `surface` are read, not its heights. `order` holds each node once. Loading ends at
/// `last_pressure` (MPa) or `last_displacement` (mm), whichever comes first; infinity: not given. Work
/// O(N^3), memory N^2: for up to a few hundred nodes.
InverseProfile inverse_profile(const Profile& surface, const Body& body, const std::vector<int>& order,
                               const Advance& advance, double last_pressure, double last_displacement);

/// Moves the heights of the nodes that do not touch at the end of loading, so that the height range is
/// last_displacement. The profile then has the last pressure at full approach, as Eq. 11 requires. Without
/// such a node the profile does not change.
InverseProfile with_range_at_last(InverseProfile inverse);

/// Moves the same heights for a periodic profile, whose contact is full at its mean plane. Afterwards
/// last_displacement is `reach` (> 0, < 1) times the height of the highest node above this plane.
InverseProfile with_mean_at_full_approach(InverseProfile inverse, double reach);

} // namespace rough
