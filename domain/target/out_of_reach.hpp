#pragma once

#include "domain/target/stiffness_limits.hpp"
#include "domain/target/target.hpp"

#include <optional>

namespace rough {

/// Why no profile whatever answers a target exactly, and how near one could come at best.
struct OutOfReach {
    std::string reason;     ///< one line, with numbers
    std::vector<double> at; ///< the target's x (MPa or mm) at fault
    double bound = 1;       ///< no profile is more similar to the target (Eq. 12, the curve that is scored)
    bool on_this_grid = false; ///< on a finer one a profile could come nearer

    /// In words: of what it is out of reach, and why.
    std::string verdict() const;
};

/// Exact tests, without a search, of each target on its own under a model solved throughout:
/// - contact sets are nested, so K(P) and contact fractions never fall: a rising curve misses two points,
///   y_i above y_j with i < j, by (y_i - y_j)/(y_i + y_j) at least;
/// - secants of K lie between one node alone and full contact, and so the curve that is scored, ends
///   continued, between scored_limits(); the lower of them is the less the finer the grid;
/// - K_i never falls either. It has no upper limit, and from the middle of the first load step on, which no
///   curve's first secant lies beyond, is at least that of one node alone; on a periodic body it is K;
/// - P(Delta) is convex from (0, 0) on, for the same reason, no steeper than full contact and no flatter than
///   one node alone.
/// The load of K(P) ends at `max_pressure` (MPa, Eq. 11), or without it at the last pressure of all targets.
/// Nothing is found where a band allows a curve of that kind. The worst of each kind is returned.
std::vector<OutOfReach> out_of_reach(const std::vector<Target>& targets, const Model& model,
                                     std::optional<double> max_pressure = {});

} // namespace rough
