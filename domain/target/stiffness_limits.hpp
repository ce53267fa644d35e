#pragma once

#include "domain/response/model.hpp"

namespace rough {

/// The stiffness of one node alone and of full contact on the grid, MPa/mm; infinite where the kernel is
/// periodic.
struct StiffnessLimits {
    double least; ///< of one node alone, MPa/mm
    double most;  ///< of full contact, MPa/mm
};
/// Of the model's grid and body.
StiffnessLimits stiffness_limits(const Model& model);

} // namespace rough
