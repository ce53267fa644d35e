#pragma once

#include "domain/profile/profile.hpp"

#include <filesystem>
#include <string>

namespace rough {

/// How the heights of a map lie, in its unit.
struct MapLayout {
    std::string unit = {};  ///< of heights and spacings, e.g. "um"; empty: mm
    double spacing = 0;     ///< delta_x, > 0
    double row_spacing = 0; ///< delta_y, > 0
};

/// Reads an area's heights from a text matrix: a line is a row along x, y grows from line to line. Heights
/// stay as they are. Throws InputError with one line that names the file, the line and what was expected:
/// fewer than 2 x 2 heights, rows of different lengths, a height that is missing or no number.
Profile read_map(const std::filesystem::path& path, const MapLayout& layout);

} // namespace rough
