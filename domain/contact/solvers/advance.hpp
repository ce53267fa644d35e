#pragma once

#include "domain/contact/solvers/problem.hpp"

#include <vector>

namespace rough {

/// The nodes that will join the contact set, by a first-order estimate, those surest to stay first. `depth`
/// is Delta - g0 - u at every node under the pressures of the old set `touching`; only depths over `least`
/// count. A penetrating run beside a contact is where its edge advances: near an edge the gap opens as
/// x^(3/2) and the depth of a raised approach as x^(1/2), so an edge advancing by s shows penetration over
/// 3s/2. A run of its own is a new summit, which touches where it is deepest. On an area a node is verified
/// in its runs along x and y, an edge's advance being the same share of either, whichever is surer.
std::vector<int> advancing_nodes(const Eigen::ArrayXd& depth, const std::vector<char>& touching, Extent shape,
                                 double least);

} // namespace rough
