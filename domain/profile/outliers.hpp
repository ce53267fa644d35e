#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Nodes of a measured profile that stand out as spikes do, in order. A node is an outlier if its height lies
/// outside all that the seven nodes on its left and the seven on its right predict, each side by its median
/// (Hampel 1974) and by its line of median slope (Theil 1950, Sen 1968), by more than six times the median
/// step between neighbours, of the whole profile and of the 24 steps around, and by three of the steps in
/// which heights are resolved. A wedge, a saw tooth, a step and a smooth peak are predicted from one side at
/// least. Nodes beside an outlier are verified again by the nodes that are none, and are part of it if they
/// stand out on the same side by half as much, so that a particle is found whole, up to where its flanks
/// return to the surface. Particles of up to four nodes are found; much wider ones are taken for the surface.
/// The first and the last three nodes, and profiles of fewer than 16, are not verified.
std::vector<Index> outliers(const Eigen::VectorXd& heights);

/// The heights with those of these nodes (increasing) put on the straight line between their neighbours.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

} // namespace rough
