#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/profile/solid.hpp"
#include "domain/response/response.hpp"

/// Notes on a surface, and its solid.
namespace app {

/// A note that a genome with a period (mm) has a step at its ends. It gives the step as a share of the height
/// range (mm). "" if the ends agree.
std::string jump_note(const rough::Genome& genome, double length, double range);

/// A note that opposite ends of measured heights differ, rms, by over three times the rms step from node to
/// node along that direction. "" if they do not.
std::string jump_note(const rough::Profile& surface);

/// A warning that the contact spots of a measured surface are narrower than resolved_spot_nodes at half of the load
/// steps of its response or more. "" if they are not, or if their widths are not known (ContactOptions::spots).
std::string resolution_warning(const rough::Response& response);

/// This warning for a surface that is not pressed, from the highest 1 % of its nodes.
std::string resolution_warning(const rough::Profile& surface, bool periodic);

/// The size of a solid, the layer steps of its relief, and the effect of its magnification on stiffness.
std::string print_note(const rough::Profile& surface, const rough::Extrusion& extrusion);

/// Writes the solid of a surface as NAME.stl and NAME.3mf. If the surface has too many nodes for a file,
/// prints that it is left out. Returns the names of the written files.
std::vector<std::string> write_solids(const rough::Profile& surface, const rough::Extrusion& extrusion,
                                      const std::filesystem::path& folder, const std::string& name);

/// Writes NAME.png, the heights in 16 bits, and NAME-scale.json, its scale. Prints why they are left out if
/// there are too many nodes. Returns the names of those written.
std::vector<std::string> write_height_image(const rough::Profile& surface, const rough::Extrusion& extrusion,
                                            const std::filesystem::path& folder, const std::string& name);

} // namespace app
