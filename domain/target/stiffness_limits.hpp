#pragma once

#include "domain/response/model.hpp"

namespace rough {

/// The stiffness of one node alone and of full contact on the grid, MPa/mm; infinite where the kernel is
/// periodic. Contact sets are nested and a larger one is stiffer, so every tangent and every secant of every
/// profile lies between, and secants never decrease.
struct StiffnessLimits {
    double least; ///< of one node alone, MPa/mm
    double most;  ///< of full contact, MPa/mm
};
/// Of the model's grid and body.
StiffnessLimits stiffness_limits(const Model& model);

/// The least and the greatest K(p) as it is scored (secant_stiffness: continued to 0 and to P_nt with the end
/// segments' slopes) that any profile can have at a share p/P_nt of its last load, MPa/mm. Sharp for secants
/// between the limits; `steps` are even and at least 2.
StiffnessLimits scored_limits(const StiffnessLimits& secants, int steps, double share);

} // namespace rough
