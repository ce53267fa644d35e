#pragma once

#include "domain/profile/profile.hpp"

#include <filesystem>
#include <string>

namespace rough {

/// How the heights of a map lie, where its file does not say.
struct MapLayout {
    std::string unit = {};  ///< of heights and spacings, e.g. "um"; empty: mm, or the file's own
    double spacing = 0;     ///< delta_x, > 0; 0: the file's own
    double row_spacing = 0; ///< delta_y, > 0; 0: the file's own
};

/// An area's heights, and how its file says that they lie.
struct Map {
    Profile heights;     ///< mm
    std::string account; ///< what was read, in a few words
};

/// Reads an area's heights: a text matrix, of which a line is a row along x and y grows from line to line;
/// three columns x, y and height of a whole grid in any order, without a spacing; or a format that says all
/// itself (X3P, SDF, SUR, GSF and others). Heights stay as they are. Throws
/// InputError with one line that names the file, the place and what was expected: fewer than 2 x 2 heights,
/// rows of different lengths, a height that is missing or no number, a spacing or unit that contradicts the
/// file's.
Map read_map(const std::filesystem::path& path, const MapLayout& layout);

/// A profile or a map (mm) as the bytes of an X3P file (ISO 25178-72): double precision, metres, with the
/// standard's check sums.
std::string x3p(const Profile& surface);

/// A map as a legacy VTK file's bytes (version 3.0, binary): a structured grid of points (x, y, z) in mm with
/// the scalar `height_mm`, which viewers show as a relief.
std::string vtk(const Profile& map);

} // namespace rough
