#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Outlying nodes of a measured profile, in order. A node is an outlier if its height is outside the range
/// that the seven nodes on each side predict. Each side predicts by its median (Hampel 1974) and by its line
/// of median slope (Theil 1950, Sen 1968). The distance from the range must be more than six times the median
/// difference between neighbours. This holds for the median over the whole profile and for that over the 24
/// differences around the node. The distance must also be more than three times the resolution of the
/// heights. A wedge, a saw tooth, a step and a smooth peak are predicted from at least one side.
///
/// Neighbours of an outlier are tested again without the outliers found so far. They belong to it if they
/// stand out on the same side by half as much. So a particle is found whole, up to where its flanks return
/// to the surface. Particles of up to four nodes are found; much wider ones count as surface. The first
/// and the last three nodes are not tested, nor profiles of fewer than 16 nodes.
std::vector<Index> outliers(const Eigen::VectorXd& heights);

/// The heights, with those of these nodes (increasing) replaced linearly between their neighbours.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

} // namespace rough
