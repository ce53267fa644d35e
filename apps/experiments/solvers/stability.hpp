#pragma once

#include "apps/experiments/solvers/trial.hpp"

/// Scenes in which contact solvers may fail, and the check of their results.
namespace app {

/// A scene on one kernel in which some method may fail.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All scenes, named as in the stability table. A scene appears once for each kernel to which it applies.
std::vector<StabilityScene> stability_scenes();

/// Turns a solved trial into a wrong one if it differs by more than the tolerance from another solver's
/// results. On small grids that is another direct solver, if one solves the scene; it also solves a tolerance
/// below and above each displacement, so that a node that just touches may count either way.
void verify(const StabilityScene& scene, ContactTrial& trial, double tolerance);

} // namespace app
