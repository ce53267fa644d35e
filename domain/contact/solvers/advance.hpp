#pragma once

#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// The nodes that will join the contact set, by a first-order estimate, the most certain first. `depth` is
/// Delta - g0 - u at every node under the pressures of the old set `touching`; only depths over `min_depth`
/// count. A penetrating run next to a contact shows that its edge advances. Near an edge the gap opens as
/// x^(3/2), and a raised approach gives the depth x^(1/2). So an edge that advances by s shows penetration
/// over 3s/2. A run without a contact at its ends is a new summit, which touches at its deepest nodes. On a
/// map a node is assessed in its runs along x and y, and the more certain result counts.
std::vector<int> advancing_nodes(const Eigen::ArrayXd& depth, const std::vector<char>& touching, Extent shape,
                                 double min_depth, Team& team = Team::alone());

} // namespace rough
