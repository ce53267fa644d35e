#pragma once

#include "domain/accuracy/respond_within.hpp"
#include "domain/problem/limits.hpp"
#include "domain/target/target.hpp"

#include <optional>

namespace rough {

/// The similarity from which an answer is called found, by default.
constexpr double default_required_similarity = 0.99;

/// Factor on the nodes and on the load steps with which an answer is verified.
constexpr int verified_refinement = 4;

/// Errors of heights in manufacturing, under which an answer must keep its similarity. 0: none.
struct MakingErrors {
    double noise = 0;        ///< rms of Gaussian height noise, mm: 95 % of draws must keep the similarity
    double noise_length = 0; ///< correlation length of the noise, mm; 0: L/60
    double tilt = 0;         ///< rise over the length in either direction, mm; 0: none

    bool any() const { return noise > 0 || tilt > 0; } ///< whether any are given
};

/// The task of a design. Values left at 0 are filled in when a search begins (`completed`): K for a target is
/// designed by search({.targets = {read_target("target.csv")}}).
struct DesignSetup {
    Model model = {};                 ///< grid, body, load steps, contact options
    std::vector<Target> targets = {}; ///< at least one; the first shapes the starts
    /// MPa: every genome is rescaled to it at its last load step (Eq. 11). Without it amplitude is a gene,
    /// and load steps end with the targets.
    std::optional<double> max_pressure = {};
    std::optional<double> threshold =
        {};                 ///< x between `low` and `high`; default: the middle of the first target
    GeneBounds bounds = {}; ///< bounds of the genes
    std::optional<PhaseReach> phases = {}; ///< if given, only phases move, within this
    MakingLimits limits = {};              ///< limits of manufacturing; shortest_wave 0: 8 node spacings
    /// The measured profile, if its response is the target. Such targets depend on the load steps.
    std::optional<Profile> like = {};
    /// The verified similarity from which a search may end and an answer is called found.
    double required_similarity = default_required_similarity;
    /// Number of ridges M of each chromosome of a drawn genome. 0: 1 on a line, because its ridges collapse
    /// to one cosine, and 8 on a map, whose ridges are directions.
    int ridges = 0;
    MakingErrors errors = {}; ///< errors under which an answer must keep its similarity
};

/// The bounds with lambda's filled in if they are 0: a quarter of the length (mm) to four times it.
GeneBounds completed(GeneBounds bounds, double length);

/// The set-up with defaults for values that are 0. These are in the model, the ridges and, unless only phases
/// move, the bounds and the shortest wave (8 node spacings). Throws InputError on a model without a solution
/// and on fewer than 16 nodes along an axis. It is also thrown on a shortest wave below a node spacing or
/// above the longest. A map with an accuracy or a strip is refused, too.
DesignSetup completed(DesignSetup setup);

/// Throws InputError if targets are missing, beyond max_pressure or cannot be loaded together. Also throws it
/// if no point lies below or above the threshold.
void validate(const DesignSetup& setup);

/// The points of the first target up to the threshold (MPa or mm), or those from it on.
std::vector<Index> points_of_half(const DesignSetup& setup, bool high);

/// The set-up without approximations, whatever accuracy its model allows.
DesignSetup exactly(DesignSetup setup);

/// The set-up with which answers are reported, without approximations. If the finer grid of a line has up to
/// 16385 nodes, every solver gives nine digits of a similarity. Larger grids and maps keep the solver's
/// tolerance.
DesignSetup as_reported(DesignSetup searched);

/// A design with the response of a measured profile as target. Sets `like`, the targets and the model. The
/// targets are the profile's response under its model. They have `points` even pressures up to the set-up's
/// max_pressure, or else up to the model's last load. They have the band of the resolution unless it is off.
/// The grid gets `nodes` nodes, or 512 if `nodes` is 0. For contact area, 0 stands for the profile's number
/// of nodes (512 to 2048). More are taken if fewer than 16 would touch at the first point. A map keeps its
/// nodes.
DesignSetup like(DesignSetup setup, Profile profile, const Model& model, const std::string& name,
                 const std::vector<Quantity>& quantities = {Quantity::stiffness, Quantity::area_at_pressure},
                 Index points = 20, Index nodes = 0, Resolution resolution = Resolution::off);

/// Names of the quantities of a scan: both (stiffness and contact area), stiffness, area or
/// interface_stiffness.
const std::vector<std::string>& names_of_likeness();
/// The quantities of that name. Throws InputError on another word.
std::vector<Quantity> likeness_named(const std::string& name);

} // namespace rough
