#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Nodes of a measured profile that stand out as spikes do, in order. A node is an outlier where its height
/// lies outside all that the seven nodes on its left and the seven on its right foretell, each side by its
/// median (Hampel 1974) and by its line of median slope (Theil 1950, Sen 1968), by more than six times the
/// median step between neighbours, of the whole profile and of the 24 steps around, and by three of the
/// steps in which heights are resolved. A wedge, a saw tooth, a step and a smooth peak are foretold from one
/// side at least, and are none. The first and the last three nodes, and those of fewer
/// than 16, are not verified. Spikes of one and two nodes are found; wider ones are taken for the surface.
std::vector<Index> outliers(const Eigen::VectorXd& heights);

/// The heights with those of these nodes (increasing) put on the straight line between their neighbours.
Eigen::VectorXd interpolated(Eigen::VectorXd heights, const std::vector<Index>& nodes);

} // namespace rough
