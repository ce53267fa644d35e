#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/accuracy/resolution.hpp"
#include "domain/mwm/genome.hpp"
#include "domain/profile/detrend.hpp"
#include "domain/response/model.hpp"
#include "domain/scan/map.hpp"
#include "domain/scan/source.hpp"

namespace app {

/// Says which pressures those of an unstated modulus are.
inline constexpr const char* modulus_note =
    "note: no --modulus or --material given: E is 1 MPa, so pressures and stiffness are in units of E";
/// Whether a modulus is stated, as --modulus or by a --material.
bool states_modulus(const Settings& settings);
/// The --material with its values and their sources in words; "" if none is given.
std::string material_note(const Settings& settings);
/// The local pressure (MPa) up to which the answer of the stated elastic body holds: the hardness of its
/// --material, or largest_elastic_pressure of a --modulus. Infinite if neither is stated, or if --hardness
/// caps pressures.
double elastic_limit(const Settings& settings, const rough::Body& body);

/// The settings that make a model: --nodes, --length, --kernel … as flags (prefix "") or keys (prefix
/// "model.").
std::vector<Setting> model_settings(const std::string& prefix = "");

/// How exactly a search or a curve must know a genome's response, for commands that can take less:
/// --accuracy. `against` says what the response is compared with.
Setting accuracy_setting(const std::string& prefix = "", const std::string& against = "the model's own");
/// 0 where none is asked for.
double accuracy_from(const Settings& settings, const std::string& prefix = "");

/// --nodes, or what stands for it where it is not given.
rough::Index nodes_from(const Settings& settings, rough::Index otherwise);

rough::Kernel kernel_from(const Settings& settings, const std::string& prefix = "");

/// The model on a grid that --nodes and --length may change, complete. Throws rough::InputError if it has no
/// solution.
rough::Model model_on(const rough::Grid& grid, const Settings& settings, const std::string& prefix = "");
/// The model they describe, complete. Throws rough::InputError where it has no solution.
rough::Model model_from(const Settings& settings, const std::string& prefix = "");
/// The same for what brings its own grid along: nodes and length default to that.
rough::Model model_from(const Settings& settings, const rough::Source& source,
                        const std::string& prefix = "");

/// The end of the load and what a node bears: --to-pressure, --pressures and --hardness.
std::vector<Setting> loading_settings();
/// The model under that load. Throws rough::InputError on loads that contradict each other.
rough::Model loaded(rough::Model model, const Settings& settings);

/// The settings that say how to read a measured profile: unit, spacing, row, outliers, form,
/// filters, fill.
std::vector<Setting> scan_settings(const std::string& prefix = "");

/// --resolution: whether a measured surface is pressed again with interpolated heights.
Setting resolution_setting();
rough::Resolution resolution_from(const Settings& settings);

/// Opens the scan. `nodes` resamples it to that many; 0 keeps its own number.
rough::Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                        const std::string& prefix = "");

/// Opens what --genome, or else --`scan`, names. Throws rough::InputError where settings of a scan are given
/// with a genome.
rough::Source source_from(const Settings& settings, rough::Index nodes, const std::string& scan = "profile");

/// The flag that names a measured area.
std::vector<Setting> area_settings();

/// Of an area on the free body.
inline constexpr const char* no_datum_note =
    "an area on a half-space needs no datum: displacements are measured to infinity";

/// Whether the settings ask for an area: by --surface, or by --nodes, --length or --spacing as a pair.
bool asks_for_area(const Settings& settings, const std::string& prefix = "");

/// The model on a surface's own nodes. Throws rough::InputError on what only a profile has.
rough::Model model_of(const rough::Profile& surface, const Settings& settings);

/// The model that the settings describe, of an area where --nodes or --length is a pair. Throws
/// rough::InputError on what only a profile has.
rough::Model surface_model_from(const Settings& settings, const std::string& prefix = "");

/// By how much a genome's wave vectors were moved to fit a periodic area; "" where none was.
std::string fit_note(const rough::Genome& genome, const rough::Grid& grid);

/// The map of the flag of that name, its form and waves removed as --detrend (by default its plane),
/// --lambda-s and --lambda-c say.
rough::Map surface_from(const Settings& settings, const std::string& flag = "surface");

/// The heights of --genome on the area of --nodes and --length, which is periodic or not.
rough::Map sampled_from(const Settings& settings, bool periodic);

/// An area as the settings give it, and what it is pressed on.
struct AreaScene {
    rough::Profile map;             ///< heights, mm
    rough::Model model;             ///< complete, with the map's grid
    std::vector<std::string> notes; ///< what was done to it, a line each
};
/// The area of the map that the flag of that name gives, or of --genome. Throws rough::InputError on what
/// only a profile has.
AreaScene area_from(const Settings& settings, const std::string& map = "surface");

} // namespace app
