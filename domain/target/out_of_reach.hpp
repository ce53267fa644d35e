#pragma once

#include "domain/target/target.hpp"

#include <optional>

namespace rough {

/// The stiffness of a single node and of full contact on the grid, MPa/mm. Contact sets only grow, and a
/// larger contact set is stiffer. So every tangent and every secant of every surface lies between these two
/// stiffnesses, and secants never fall with the load.
struct StiffnessLimits {
    double min; ///< stiffness of a single node, MPa/mm
    double max; ///< stiffness of full contact, MPa/mm; infinite for the periodic kernel
};
StiffnessLimits stiffness_limits(const Model& model); ///< the limits for the model's grid and body

/// The lowest and highest stiffness K, MPa/mm, that the scored curve of any surface can have at the pressure `share`
/// P_nt. P_nt is the last load. The scored curve is the curve of secant_stiffness(). It is continued to 0 and P_nt with
/// the slopes of its end segments. If all secants lie within `secants`, the limits are sharp. `steps` is the number of
/// equal load steps, at least 2.
StiffnessLimits scored_limits(const StiffnessLimits& secants, int steps, double share);

/// The reason why no surface can match a target exactly, and an upper bound on the similarity.
struct OutOfReach {
    std::string reason;        ///< reason in one line, with numbers
    std::vector<double> at;    ///< x of the target's points at fault, MPa or mm
    double bound = 1;          ///< upper bound on the similarity (Eq. 12, scored curve) of any surface
    bool on_this_grid = false; ///< whether a surface on a finer grid could have a higher similarity
    bool of_map = false;       ///< whether it is about maps

    std::string verdict() const; ///< the verdict in words, with the reason
};

/// Exact tests of each target, without a search, for a model that is solved without approximation. Contact
/// sets only grow. So stiffness K(P), interface stiffness K_i(P) and contact fractions never fall with the
/// load P, and P(Delta) is convex from (0, 0) on. Secants of K and slopes of P(Delta) lie between the
/// stiffness of a single node and the stiffness of full contact. K_i has no upper limit. From the middle of
/// the first load step on, it is at least the K_i of a single node. On a periodic body K_i = K.
///
/// The last pressure of K(P) is `max_pressure` (MPa, Eq. 11) if it is given, and otherwise the last pressure of all
/// targets. A target passes a test if its band contains a curve that fulfils the condition. For each test that a target
/// fails, returns the violation with the lowest bound. Returns nothing if contact sets may shrink (contact_sets_nest).
///
/// On a free map contact sets only grow because of the signs of the inverse of H, which a test computes. On
/// the grid of a periodic map it is not proven, and the reasons say so.
std::vector<OutOfReach> out_of_reach(const std::vector<Target>& targets, const Model& model,
                                     std::optional<double> max_pressure = {});

} // namespace rough
