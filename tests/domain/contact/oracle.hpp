#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// A slow independent solution for grids of up to some hundred nodes. Influence coefficients are the printed
/// formulas in extended precision (80 bits here). Each contact set is factored from the start, and its nodes
/// are released from full contact downwards. With a hardness, it presses node after node within its bounds
/// until nothing moves (projected Gauss-Seidel). One entry per displacement.
struct Oracle {
    std::vector<double> pressure;                   ///< P, MPa
    std::vector<double> tangent_stiffness;          ///< dP/dDelta on the contact set, MPa/mm
    std::vector<Index> contact_nodes;               ///< how many nodes touch
    std::vector<Index> held_nodes;                  ///< how many of them stand at the hardness
    std::vector<std::vector<double>> node_pressure; ///< with a hardness: p at every node, MPa
};

/// Displacements in mm, > 0. Of layered bodies it knows those with one layer on a rigid base. Throws
/// NotConverged if rounding keeps the contact set from settling.
Oracle consult_oracle(const Profile& profile, const Body& body, const std::vector<double>& displacements);

/// u/p over 2/(E* q) of one layer of thickness t on a rigid base, s = q t, in closed form.
long double layer_on_rigid_base(long double nu, long double s);

} // namespace rough
