#pragma once

#include "domain/mwm/response.hpp"
#include "domain/problem/limits.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// Default value of the required similarity, from which an answer is reported as found.
constexpr double default_required_similarity = 0.99;

/// Errors of heights in manufacturing, under which an answer must keep its similarity. 0: none.
struct MakingErrors {
    double noise = 0;        ///< rms of Gaussian height noise, mm: 95 % of draws must keep the similarity
    double noise_length = 0; ///< correlation length of the noise, mm
    double tilt = 0;         ///< difference in height over the length, in either direction, mm

    bool any() const { return noise > 0 || tilt > 0; } ///< whether any are given
};

/// The task of a design. It is complete from the beginning: the model is given first, and all that is not
/// given gets the default for that model. An example is search({.targets = {read_target("target.csv")}}).
struct DesignSetup {
    Model model = completed(Model()); ///< grid, body, load steps, contact options; complete
    std::vector<Target> targets = {}; ///< at least one; starts are made for the first one
    /// Mean pressure (MPa) to which every genome is rescaled at its last load step (Eq. 11). If it is not
    /// given, amplitude is a gene, and load steps end with the targets.
    std::optional<double> max_pressure = {};
    /// Threshold in x between the objectives `low` and `high`. Default: the middle of the first target.
    std::optional<double> threshold = {};
    /// Bounds of the genes. Default: series have longest wavelengths from L/4 to 4 L.
    GeneBounds bounds = {.lambda_from = 0.25 * model.grid.length, .lambda_to = 4 * model.grid.length};
    std::optional<PhaseReach> phases = {}; ///< if it is given, only phases move, at most this far
    /// Limits of manufacturing. Default: wavelengths of 8 node spacings; none if only phases move.
    MakingLimits limits = {.shortest_wave = phases ? 0 : 8 * model.grid.widest_spacing()};
    /// The measured profile if its response is the target. Such targets depend on the load steps.
    std::optional<Profile> measured = {};
    /// The verified similarity from which a search may end and an answer is reported as found.
    double required_similarity = default_required_similarity;
    /// Number of ridges M of each chromosome of a drawn genome. Default: 1 on a line, because all ridges of a
    /// chromosome together are one cosine, and 8 on a map, on which ridges are directions.
    int ridges = model.grid.is_2d() ? 8 : 1;
    /// Whether a search reads contact fractions as its derivatives do (contact/interface.hpp). They are less
    /// off on a coarse grid. The verification counts nodes.
    bool smooth_area = false;
    /// Errors under which an answer must keep its similarity. Default: none, at a noise length of L/60.
    MakingErrors errors = {.noise_length = model.grid.length / 60};
};

/// Throws InputError on a model that is not complete or has no solution. Also throws it on fewer than 16
/// nodes along an axis, on an accuracy, and on a map with a strip. Unless only phases move, throws it on a
/// shortest wavelength below a node spacing or above the longest.
///
/// Throws it, too, if targets are missing, invalid, recorded for another model, or beyond max_pressure. Also
/// throws it on a target against displacement under Eq. 11, and on a threshold that has no point on one side.
void validate(const DesignSetup& setup);

/// The indices of the first target's points up to the threshold (MPa or mm), or if `high` from it on.
std::vector<Index> points_of_half(const DesignSetup& setup, bool high);

/// The set-up whose nodes along each side are halved this often, unless the grid becomes too coarse.
DesignSetup on_coarser_grid(DesignSetup setup, int halvings);

/// The set-up with which answers are reported. If the finer grid of a line has up to 16385 nodes, the
/// tolerance is lowered so that similarities have nine digits with every solver.
DesignSetup as_reported(DesignSetup setup);

/// A design with the response of a measured profile as target. The targets are the profile's response under
/// `model`. They have `points` evenly spaced pressures up to `max_pressure` (MPa) if it is given, otherwise
/// up to the model's last load. Unless `resolution` is off, they have the band of target_like(). It is cut at
/// 5 % from the profile's response on either side, because the design must also be near the measured curve.
///
/// The grid gets `nodes` (one row for a line). For a line the default is 512 nodes. For contact area it is the
/// profile's number of nodes (512 to 4096). It is more if fewer than 32 nodes would touch at the first point. For a map
/// it is the map's nodes.
DesignSetup design_like(const Profile& profile, Model model, const std::string& name,
                        const std::vector<Quantity>& quantities = {Quantity::stiffness, Quantity::area_at_pressure},
                        Index points = 20, std::optional<Extent> nodes = {}, Resolution resolution = Resolution::off,
                        std::optional<double> max_pressure = {});

/// The names of the quantities of a scan that a design can match: `both` (stiffness and contact area),
/// `stiffness`, `area` and `interface_stiffness`.
const std::vector<std::string>& names_of_likeness();
/// The quantities of that name. Throws InputError on another word.
std::vector<Quantity> likeness_named(const std::string& name);

} // namespace rough
