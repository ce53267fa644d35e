#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"

#include <vector>

namespace rough {

/// The secant stiffness at each of a profile's load steps (MPa/mm) as a coarse grid foretells it: every few
/// nodes, every second step. An estimate without a bound. `displacements` are the steps', mm. Empty where the
/// profile has too few nodes to leave some out, the coarse grid no solution, or the kernel is not the free
/// one, the only one whose errors were measured.
std::vector<double> foretold_secants(const Profile& profile, const Model& model,
                                     const std::vector<double>& displacements);

} // namespace rough
