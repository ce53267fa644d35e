#pragma once

#include "apps/experiments/solvers/trial.hpp"

/// Scenes in which contact solvers may fail, and the check of their results.
namespace app {

/// A scene on one kernel in which some method may fail.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All scenes, named as in the stability table. A scene appears once for each kernel to which it applies.
/// Maps of 256 and 1024 nodes a side are added if `large`.
std::vector<StabilityScene> stability_scenes(bool large = false);

/// Turns a solved trial into a wrong one if it differs by more than the tolerance from another solver's
/// results. On small grids that is another direct solver, if one solves the scene; it also solves a tolerance
/// below and above each displacement, so that a node that just touches may count either way. At pressures the
/// displacement is compared, and a thousandth of the nodes may differ.
void verify(const StabilityScene& scene, ContactTrial& trial, double tolerance);

} // namespace app
