#pragma once

#include "apps/report/profile_page.hpp"
#include "domain/profile/areal.hpp"

namespace app {

/// The set of ISO 25178-2 that surface.json holds.
std::vector<Parameter> parameters(const rough::ArealParameters& areal);

/// What a page about a map shows.
struct MapShown {
    std::string name;    ///< of its file
    std::string account; ///< what was read and done
    const rough::Profile& map;
    const std::vector<Parameter>& parameters; ///< of the table
    const rough::Spectrum& spectrum;
    Plot heights;                   ///< as colours
    std::vector<std::string> files; ///< beside the page
};

/// The page, HTML.
std::string map_page(const MapShown& shown);

} // namespace app
