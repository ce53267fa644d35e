#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/profile/solid.hpp"

#include <filesystem>

/// What is said of a surface, and its solid.
namespace app {

/// In words: that a genome jumps at the ends of a length (mm) if it is continued with that period, and by
/// which share of its height range (mm); "" where it does not.
std::string jump_note(const rough::Genome& genome, double length, double range);

/// The same of measured heights: that their opposite ends differ, rms, by over three times the rms step from
/// node to node along that direction.
std::string jump_note(const rough::Profile& surface);

/// In words: that a genome has waves under 8 node distances; "" where it has none.
std::string wave_note(const rough::Genome& genome, const rough::Grid& grid);

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
