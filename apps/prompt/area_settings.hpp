#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/mwm/genome.hpp"
#include "domain/profile/detrend.hpp"
#include "domain/response/model.hpp"
#include "domain/scan/map.hpp"

namespace app {

/// The flag that names a measured area.
std::vector<Setting> area_settings();

/// Whether the settings ask for an area: by --surface, or by --nodes or --length as a pair.
bool asks_for_area(const Settings& settings);

/// The map of --surface, its form and waves taken off as --detrend (`form` where that is not given),
/// --lambda-s and --lambda-c say; `known` are the command's settings.
rough::Map surface_from(const Settings& settings, const std::vector<Setting>& known, rough::Detrend form);

/// An area as the settings give it, and what it is pressed on.
struct AreaScene {
    rough::Profile map;             ///< heights, mm
    rough::Model model;             ///< complete, with the map's grid
    std::vector<std::string> notes; ///< what was done to it, a line each
};
/// The area of --surface or of --genome; `known` are the command's settings. Throws rough::InputError on what
/// only a profile has.
AreaScene area_from(const Settings& settings, const std::vector<Setting>& known);

} // namespace app
