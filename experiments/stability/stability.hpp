#pragma once

#include "apps/experiments/trial.hpp"
#include "ga/base/json.hpp"

#include <atomic>
#include <set>

/// Scenes in which contact solvers may fail, and the check of their results.
namespace app {

/// The change of a map: none, 16 levels of height, one high spike, a flat top, or an offset of 1e6 mm.
enum class MapShape { rough, quantised, spiked, plateaued, raised };
constexpr int map_shapes = 5; ///< number of shapes

/// A self-affine map's Hurst exponent, shortest wavelength in node spacings, seed, shape, and the spacing of
/// its rows over that of its columns.
struct SelfAffineMap {
    double hurst, shortest;
    std::uint64_t seed;
    MapShape shape = MapShape::rough;
    double stretch = 1;
};
/// A map under one load. By Persson's theory the load gives the contact fraction `contact`. On a periodic
/// body it is at most 0.999 times the load of full contact. Throws InputError if the grid is too coarse.
ContactScene map_scene(const std::string& name, const rough::Body& body, rough::Extent shape,
                       const SelfAffineMap& roughness, double contact);

/// All scenes, named as in the stability table. A scene appears once for each kernel to which it applies.
/// Maps of 256 x 256 and 1024 x 1024 nodes are added if `large`.
std::vector<ContactScene> stability_scenes(bool large = false);

///@{ Scenes of maps that a search has bred. Genes are thousandths, 0 to 1000, as 0 to 1 in the name "bred
/// G,G,...". It is enough to press the scene again; a name with the 11 genes of earlier versions is, too. The
/// last three genes are the shape, the ratio of the spacings, and a load near full contact. Throws InputError
/// on a name with other words.
std::string bred_name(const std::vector<double>& genome);
bool is_bred(const std::string& name);
ContactScene bred_scene(const std::string& name);
///@}
/// Breeds maps on which the solver `auto` fails, is contradicted by another one, or takes the most products with H per
/// load step. A genetic algorithm of the engine presses `evaluations` maps. Returns the ten worst, the worst first.
std::vector<ContactScene> bred_scenes(long evaluations, std::uint64_t seed, int threads, const std::atomic<bool>& stop);

/// The verdict on trials in words: first wrong curves, then the scenes on which `auto` failed, then numbers
/// of the other solvers. `rows` have scene, kernel, method and outcome; `unsolvable` are scenes without a
/// solution, as "nan (free)".
std::string stability_verdict(const nlohmann::json& rows, const std::set<std::string>& unsolvable);

/// Sets the outcome of a solved trial to `wrong` if it differs by more than its tolerance from the results of
/// another solver. On lines of up to 256 nodes the other solver is direct, if a direct one solves the scene.
/// It also solves displacements that are a tolerance smaller and larger, because a node that just touches may
/// or may not count. Results must lie in the range of these solutions.
///
/// Under loads the other solver solves the displacements that were found. The given loads must then lie in the range of
/// its pressures, and a thousandth of the nodes may differ. Load steps that no other solver solves are not compared.
void verify(const ContactScene& scene, ContactTrial& trial);

} // namespace app
