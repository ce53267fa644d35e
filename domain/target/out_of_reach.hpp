#pragma once

#include "domain/target/target.hpp"

#include <optional>

namespace rough {

/// The stiffness of a single node and of full contact on the grid, MPa/mm. Contact sets are nested and a
/// larger one is stiffer. So every tangent and every secant of every profile lies between, and secants never
/// fall.
struct StiffnessLimits {
    double min; ///< a single node, MPa/mm
    double max; ///< full contact, MPa/mm; infinite for the periodic kernel
};
/// The limits for the model's grid and body.
StiffnessLimits stiffness_limits(const Model& model);

/// The lowest and highest K(p), MPa/mm, that any profile's scored curve can have at a share p/P_nt of its
/// last load. The scored curve (secant_stiffness) is continued to 0 and P_nt with the slopes of its end
/// segments. The limits are sharp if all secants lie between `secants`. `steps` are even and at least 2.
StiffnessLimits scored_limits(const StiffnessLimits& secants, int steps, double share);

/// The reason why no profile can match a target exactly, and an upper bound on the similarity.
struct OutOfReach {
    std::string reason;     ///< one line, with numbers
    std::vector<double> at; ///< the target's x (MPa or mm) at fault
    double bound = 1;       ///< no profile has a higher similarity to the target (Eq. 12, the scored curve)
    bool on_this_grid = false; ///< whether a profile on a finer grid could have a higher similarity

    /// The verdict in words, with the reason.
    std::string verdict() const;
};

/// Exact tests of each target, without a search, for a model that is solved without approximation:
///
/// - Contact sets are nested, so K(P) and contact fractions never fall. Let y_i > y_j with i < j. A curve
///   that does not fall differs from one of them by at least the share (y_i - y_j)/(y_i + y_j).
/// - Secants of K lie between a single node and full contact. So the scored curve, with its ends continued,
///   lies between scored_limits(). The lower limit falls as the grid is refined.
/// - K_i never falls either, and its upper limit is infinite. The first secant of a curve is in the middle of
/// the first load step. From there on K_i is at least that of a single node. On a periodic body K_i = K.
/// - P(Delta) is convex from (0, 0) on, for the same reason. Its slope is at most that of full contact and at
///   least that of a single node.
///
/// The load of K(P) ends at `max_pressure` (MPa, Eq. 11), or without it at the last pressure of all targets.
/// A target passes a test if its band contains a curve that fulfils the condition. Returns the worst
/// violation of each kind.
std::vector<OutOfReach> out_of_reach(const std::vector<Target>& targets, const Model& model,
                                     std::optional<double> max_pressure = {});

} // namespace rough
