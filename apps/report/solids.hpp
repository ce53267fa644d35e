#pragma once

#include "domain/profile/solid.hpp"

#include <filesystem>

namespace app {

/// A surface's solid as files' bytes, each empty where it would be of no use.
struct Solids {
    std::string stl, three_mf;
    rough::Index nodes = 0;
};
Solids solids_of(const rough::Profile& surface, const rough::Extrusion& extrusion);

/// Writes NAME.stl and NAME.3mf, and says which is left out and why; returns those written.
std::vector<std::string> write_solids(const Solids& solids, const std::filesystem::path& folder,
                                      const std::string& name);

} // namespace app
