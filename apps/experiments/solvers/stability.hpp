#pragma once

#include "apps/experiments/solvers/trial.hpp"

#include <atomic>

/// Scenes in which contact solvers may fail, and the check of their results.
namespace app {

/// A scene on one kernel in which some method may fail.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// A self-affine map's Hurst exponent, shortest wavelength in node spacings, and seed.
struct Roughness {
    double hurst, shortest;
    std::uint64_t seed;
};
/// A map under the load that brings about a contact fraction by Persson's theory, on a periodic body at most
/// 0.999 of full contact's. A single load begins on the coarsest grid. Throws InputError if the grid is too
/// coarse for the waves.
StabilityScene map_scene(const std::string& name, const rough::Body& body, rough::Extent shape,
                         const Roughness& roughness, double contact);

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
/// results. On small grids that is another direct solver, if one solves the scene. It also solves a tolerance
/// below and above each displacement, because a node that just touches may or may not count. Under loads it
/// solves the displacements found, and must carry the loads. There a thousandth of the nodes may differ.
void verify(const StabilityScene& scene, ContactTrial& trial, double tolerance);

} // namespace app
