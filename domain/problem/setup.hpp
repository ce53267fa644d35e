#pragma once

#include "domain/mwm/response.hpp"
#include "domain/problem/limits.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// Default value of the required similarity, from which an answer is reported as found.
constexpr double default_required_similarity = 0.99;

/// Factor on the number of elements and on the number of load steps in the verification of an answer.
constexpr int verified_refinement = 4;

/// Errors of heights in manufacturing, under which an answer must keep its similarity. 0: none.
struct MakingErrors {
    double noise = 0;        ///< rms of Gaussian height noise, mm: 95 % of draws must keep the similarity
    double noise_length = 0; ///< correlation length of the noise, mm; 0: L/60
    double tilt = 0;         ///< difference in height over the length, in either direction, mm

    bool any() const { return noise > 0 || tilt > 0; } ///< whether any are given
};

/// The task of a design. Values that are 0 get their defaults when a search begins (`completed`). An example
/// of a complete task is search({.targets = {read_target("target.csv")}}).
struct DesignSetup {
    Model model = {};                 ///< grid, body, load steps, contact options
    std::vector<Target> targets = {}; ///< at least one; starts are made for the first one
    /// Mean pressure (MPa) to which every genome is rescaled at its last load step (Eq. 11). If it is not
    /// given, amplitude is a gene, and load steps end with the targets.
    std::optional<double> max_pressure = {};
    /// Threshold in x between the objectives `low` and `high`. Default: the middle of the first target.
    std::optional<double> threshold = {};
    GeneBounds bounds = {};                ///< bounds of the genes
    std::optional<PhaseReach> phases = {}; ///< if it is given, only phases move, at most this far
    MakingLimits limits = {};              ///< limits of manufacturing; shortest_wave 0: 8 node spacings
    /// The measured profile if its response is the target. Such targets depend on the load steps.
    std::optional<Profile> like = {};
    /// The verified similarity from which a search may end and an answer is reported as found.
    double required_similarity = default_required_similarity;
    /// Number of ridges M of each chromosome of a drawn genome. 0: 1 on a line, because all ridges of a
    /// chromosome together are one cosine, and 8 on a map, on which ridges are directions.
    int ridges = 0;
    MakingErrors errors = {}; ///< errors under which an answer must keep its similarity
};

/// The bounds, with L/4 and 4 L in place of bounds of lambda that are 0; L is the length, mm.
GeneBounds completed(GeneBounds bounds, double length);

/// The set-up with default values in place of zeros of the model and the ridges. Unless only phases move, the
/// bounds and the shortest wavelength (8 node spacings) get their defaults, too. Throws InputError on a model
/// without a solution, and on fewer than 16 nodes along an axis. Also throws it on a shortest wavelength
/// below a node spacing or above the longest, and on a map with an accuracy or a strip.
DesignSetup completed(DesignSetup setup);

/// Throws InputError if targets are missing, invalid, recorded for another model, or beyond max_pressure.
/// Also throws it on a target against displacement under Eq. 11, and on a threshold that has no point on one
/// side.
void validate(const DesignSetup& setup);

/// The indices of the first target's points up to the threshold (MPa or mm). If `high` is set, the points
/// from the threshold on.
std::vector<Index> points_of_half(const DesignSetup& setup, bool high);

/// The set-up with Model::accuracy 0: its responses are computed without approximations.
DesignSetup exactly(DesignSetup setup);

/// The set-up with which answers are reported, without approximations. If the finer grid of a line has up to
/// 16385 nodes, the tolerance is lowered so that similarities have nine digits with every solver. Larger
/// grids and maps keep the tolerance.
DesignSetup as_reported(DesignSetup searched);

/// A design with the response of a measured profile as target. Sets `like`, the targets and the model. The
/// targets are the profile's response under `model`. They have `points` evenly spaced pressures up to the
/// set-up's max_pressure if it is given, otherwise up to the model's last load. Unless `resolution` is off,
/// they have the band of target_like(). It is cut at 5 % from the profile's response on either side, because
/// the design must also be near the measured curve.
///
/// The grid gets `nodes` nodes, or 512 if `nodes` is 0. For contact area, 0 stands for the profile's number
/// of nodes (512 to 4096). It stands for more if fewer than 32 nodes would touch at the first point. A map
/// keeps its nodes.
DesignSetup like(DesignSetup setup, Profile profile, const Model& model, const std::string& name,
                 const std::vector<Quantity>& quantities = {Quantity::stiffness, Quantity::area_at_pressure},
                 Index points = 20, Index nodes = 0, Resolution resolution = Resolution::off);

/// The names of the quantities of a scan that a design can match: `both` (stiffness and contact area),
/// `stiffness`, `area` and `interface_stiffness`.
const std::vector<std::string>& names_of_likeness();
/// The quantities of that name. Throws InputError on another word.
std::vector<Quantity> likeness_named(const std::string& name);

} // namespace rough
