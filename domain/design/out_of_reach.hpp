#pragma once

#include "domain/design/problem.hpp"
#include "domain/target/stiffness_limits.hpp"

namespace rough {

/// Why no profile whatever answers a goal exactly, and how near one could come at best.
struct OutOfReach {
    std::string reason;     ///< one line, with numbers
    std::vector<double> at; ///< the goal's x (MPa or mm) at fault
    /// No profile's own curve is more similar to the goal. The scored one may pass it by a little at the ends
    /// of its load, to where it is continued by its last segments' slopes.
    double bound = 1;
    bool on_this_grid = false; ///< on a finer one a profile could come nearer

    /// In words: of what it is out of reach, and why.
    std::string verdict() const;
};

/// Exact tests, without a search, of each goal on its own:
/// - contact sets are nested, so K(P) and contact fractions never fall: a rising curve misses two points,
///   y_i above y_j with i < j, by (y_i - y_j)/(y_i + y_j) at least;
/// - K is at most that of full contact and at least that of one node on the grid (for secants and what lies
///   between them, too), which is the less the finer the grid;
/// - P(Delta) is convex from (0, 0) on, for the same reason, and no steeper than full contact.
/// Nothing is found where a band allows a curve of that kind. The worst of each kind is returned.
std::vector<OutOfReach> out_of_reach(const DesignSetup& setup);

} // namespace rough
