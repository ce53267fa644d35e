#pragma once

#include "domain/scan/height_map.hpp"

namespace rough {

/// Reads ASCII surface data files (ISO 25178-71 SDF, BCR), softgauges (ISO 5436-2 SMD), Talysurf's PRF (as
/// NPL's softgauges have it), PTB's PR, and SigmaSurf's data files; nothing where the lines are none of
/// these. Throws InputError naming file and line on one that cannot be read as a profile or a map.
std::optional<HeightMap> named_map(const std::vector<std::string>& lines, const std::string& file);

} // namespace rough
