#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/accuracy/resolution.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/scan/scan.hpp"
#include "domain/text/unit.hpp"

namespace app {

/// A line profile from a file: a genome, which has a height at every x, or a measured scan.
struct Source : rough::Scan {
    std::optional<rough::Genome> genome = {}; ///< nothing for a scan
    double length = rough::standard_length;   ///< length of a genome's profile, mm; not used for a scan

    /// The grid of a scan, or 512 nodes for a genome. `periodic` is for the periodic kernel.
    rough::Grid grid(bool periodic = false) const;
    /// Heights on a grid: a genome's waves or a scan's points.
    rough::Profile on(const rough::Grid& grid) const;
};
/// Opens a genome file (JSON). Throws InputError as read_genome_file.
Source open_genome(const std::filesystem::path& file);

inline constexpr const char* modulus_note =
    "note: no --modulus or --material given: E is 1 MPa, so pressures and stiffness are in units of E";
/// Whether a modulus is given, by --modulus or --material.
bool states_modulus(const Settings& settings);
/// The --material with its values and their sources in words; "" if none is given.
std::string material_note(const Settings& settings);
/// The local pressure (MPa) up to which the response of the elastic body holds: the hardness of its
/// --material, or largest_elastic_pressure of a --modulus. Infinite if neither is given, or if --hardness
/// caps pressures.
double elastic_limit(const Settings& settings, const rough::Body& body);

/// The numbers of nodes of a map along x and y by --nodes, if it is given; one number stands for both.
std::optional<rough::Extent> cells_from(const Settings& settings, const std::string& prefix = "");

/// The settings of a model: --nodes, --length, --kernel … as flags (prefix "") or keys (prefix "model.").
std::vector<Setting> model_settings(const std::string& prefix = "");

/// The settings of an array of caps, each name behind `prefix`.
std::vector<Setting> cap_settings(const std::string& prefix = "");

/// The bindings and the bounds of H and gamma of genomes. A genome with a gamma near 1 has very many waves.
template <class Bounds>
Bindings with_bounds(Bindings bindings, Bounds& of, double min_gamma = 1.001) {
    bindings.insert(
        bindings.end(),
        {{ga::number("hurst-from", ga::number(of.H_from), ga::above_zero, 10, "lower bound of H"), of.H_from},
         {ga::number("hurst-to", ga::number(of.H_to), ga::above_zero, 10, "upper bound of H"), of.H_to},
         {ga::number("gamma-from", ga::number(of.gamma_from), min_gamma, 1000, "lower bound of gamma"), of.gamma_from},
         {ga::number("gamma-to", ga::number(of.gamma_to), min_gamma, 1000, "upper bound of gamma"), of.gamma_to}});
    return bindings;
}

/// --accuracy: the error allowed for the response of a genome. `against` says what the error is relative to.
Setting accuracy_setting(const std::string& against);

///@{
/// The complete model that the settings describe. Its grid is given, the default or that of a source;
/// --nodes and --length may change it. Throws rough::InputError if the model has no solution.
rough::Model model_from(const Settings& settings, const std::string& prefix = "", const rough::Grid& grid = {});
rough::Model model_from(const Settings& settings, const Source& source, const std::string& prefix = "");
///@}

/// The last load and the cap of local pressures: --to-pressure, --pressures and --hardness.
std::vector<Setting> loading_settings();
/// The model under these loads. Throws rough::InputError on loads that contradict each other.
rough::Model loaded(rough::Model model, const Settings& settings);

/// How to read a measured profile: unit, spacing, row, outliers, form, filters, fill.
std::vector<Setting> scan_settings(const std::string& prefix = "");

/// --resolution: whether a measured surface is pressed again with interpolated heights.
Setting resolution_setting();
rough::Resolution resolution_from(const Settings& settings);

/// Opens a scan and resamples it to `nodes` nodes; 0 keeps the number of its points. Missing points are
/// refused without --fill, unless `keep_missing` is set.
Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                 const std::string& prefix = "", bool keep_missing = false);

/// Opens the file of --genome, or else of --`scan`, resampled to --nodes if they are given. Throws
/// rough::InputError if settings of a scan are given with a genome.
Source source_from(const Settings& settings, const std::string& scan, bool keep_missing = false);

/// The effect of filled points on the contact, in words, with a warning if they are more than 5 %.
std::string fill_note(const rough::Profile& surface, const std::vector<rough::Index>& filled,
                      const rough::Model& model);

/// --surface: a measured map.
Setting map_setting();
/// The settings that name a surface, of which one is given: a genome, a measured profile or a map.
inline const std::vector<std::string> surface_names{"genome", "profile", "surface"};
std::vector<Setting> surface_settings();

inline constexpr const char* no_datum_note =
    "a map on a half-space needs no datum: displacements are measured to infinity";

/// Whether the settings request a map: by --surface, or by --nodes, --length or --spacing as a pair.
bool asks_for_map(const Settings& settings, const std::string& prefix = "");

/// The model on the nodes of a surface. Throws rough::InputError on settings that only a profile has.
rough::Model model_of(const rough::Profile& surface, const Settings& settings);

/// The model that the settings describe, 2-D if --nodes or --length is a pair. Throws rough::InputError on
/// settings that only a profile has.
rough::Model surface_model_from(const Settings& settings, const std::string& prefix = "");

/// The map of the flag, without its form (--detrend, by default its plane) and the wavelengths that
/// --lambda-s and --lambda-c remove. It is resampled to --nodes if they are given. Missing points as by scan_from().
rough::Scan surface_from(const Settings& settings, const std::string& flag = "surface", bool keep_missing = false);

/// The heights of --genome on the map of --nodes and --length, which is periodic or not.
rough::Scan sampled_from(const Settings& settings, bool periodic);

/// A map or a profile, and the model under which it is pressed.
struct Scene {
    rough::Profile surface;                  ///< heights, mm
    rough::Model model;                      ///< complete, with the map's grid
    std::vector<rough::Index> missing = {};  ///< nodes whose heights were missing and are filled
    std::vector<rough::Index> outliers = {}; ///< nodes that stand out and were kept
    std::vector<std::string> notes;          ///< how it was read or sampled, one line each; "": none
};
/// The map of --genome or of the file that the flag names. Throws rough::InputError on settings of a profile.
Scene map_from(const Settings& settings, const std::string& map);
/// The profile or map of --genome or of the file that the flag names. Filled points have a note.
Scene scene_from(const Settings& settings, const std::string& flag, bool is_map);

} // namespace app
