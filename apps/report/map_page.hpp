#pragma once

#include "apps/report/profile_page.hpp"

namespace app {

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
