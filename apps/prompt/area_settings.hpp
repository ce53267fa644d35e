#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/mwm/genome.hpp"
#include "domain/profile/detrend.hpp"
#include "domain/response/model.hpp"
#include "domain/scan/map.hpp"

namespace app {

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

/// The heights of --genome on the area of --nodes and --length, which wraps or not; the least nodes a side.
rough::Map sampled_from(const Settings& settings, bool wraps, rough::Index least);

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
