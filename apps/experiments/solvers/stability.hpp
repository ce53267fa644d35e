#pragma once

#include "apps/experiments/solvers/trial.hpp"

#include <atomic>

/// Scenes in which contact solvers may fail, and the check of their results.
namespace app {

/// A scene on one kernel in which some method may fail.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All scenes, named as in the stability table. A scene appears once for each kernel to which it applies.
/// Maps of 256 and 1024 nodes a side are added if `large`.
std::vector<StabilityScene> stability_scenes(bool large = false);

///@{ Scenes of maps that a search has bred. The name "bred G,G,..." holds the genes, thousandths from 0 to 1.
/// It is enough to press the scene again. Throws InputError on a name with other words.
std::string bred_name(const std::vector<double>& genome);
bool is_bred(const std::string& name);
StabilityScene bred_scene(const std::string& name);
///@}
/// Breeds maps on which the solver `auto` fails, is contradicted by another one, or takes the most products
/// with H per load step. A genetic algorithm of the engine presses `evaluations` maps. Returns the ten worst,
/// the worst first.
std::vector<StabilityScene> bred_scenes(long evaluations, std::uint64_t seed, int threads,
                                        const std::atomic<bool>& stop);

/// Turns a solved trial into a wrong one if it differs by more than the tolerance from another solver's
/// results. On small grids that is another direct solver, if one solves the scene; it also solves a tolerance
/// below and above each displacement, so that a node that just touches may count either way. At pressures the
/// displacement is compared, and a thousandth of the nodes may differ.
void verify(const StabilityScene& scene, ContactTrial& trial, double tolerance);

} // namespace app
