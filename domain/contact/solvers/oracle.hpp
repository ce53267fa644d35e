#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// A slow second opinion for small grids that shares nothing with the solvers but the question: influence
/// coefficients by the printed formulas in extended precision (80 bits here), the whole contact set factored
/// anew each time, nodes released from full contact downwards; with a hardness, node after node pressed
/// within its bounds until nothing moves (projected Gauss-Seidel). For verifying the solvers; N up to some
/// hundreds. Pressures and stiffness in MPa, MPa/mm; one entry a displacement (mm, > 0).
struct Oracle {
    std::vector<double> pressure;                   ///< P, MPa
    std::vector<double> tangent_stiffness;          ///< dP/dDelta on the contact set, MPa/mm
    std::vector<Index> contact_nodes;               ///< how many nodes touch
    std::vector<Index> held_nodes;                  ///< how many of them bear the hardness
    std::vector<std::vector<double>> node_pressure; ///< with a hardness: p at every node, MPa
};

/// Throws NotConverged where rounding keeps the contact set from settling.
Oracle consult_oracle(const Profile& profile, const Body& body, const std::vector<double>& displacements);

} // namespace rough
