#pragma once

#include "domain/profile/profile.hpp"

#include <filesystem>
#include <string>

namespace rough {

/// Unit and spacings of a map whose file does not state them.
struct MapLayout {
    std::string unit = {};  ///< for heights and spacings, e.g. "um"; empty: mm, or the file's unit
    double spacing = 0;     ///< delta_x, > 0; 0: from the file
    double row_spacing = 0; ///< delta_y, > 0; 0: from the file
};

/// A map's heights, and what its file states about them.
struct Map {
    Profile heights;     ///< mm
    std::string account; ///< format and unit, in a few words
};

/// Reads a map's heights, without changing them. The lines of a text matrix are rows along x, y grows from
/// line to line. Without a spacing, three columns are x, y and height of a whole grid in any order. X3P, SDF,
/// SUR, GSF and other formats have units and spacings.
///
/// Throws InputError with one line that names the file and the place. Faults are fewer than 2 x 2 heights,
/// rows of different lengths, a missing height, or a spacing or unit that contradicts the file's.
Map read_map(const std::filesystem::path& path, const MapLayout& layout);

/// A profile or a map (mm) as the bytes of an X3P file (ISO 25178-72): double precision, metres, with the
/// standard's check sums.
std::string x3p(const Profile& surface);

/// A profile or a map (mm) as the bytes of a Digital Surf file (PRO or SUR): heights in whole numbers of 32
/// bits, to 5e-10 of the highest |height|. Throws InputError on over 2^31 - 1 heights.
std::string sur(const Profile& surface);

/// A map as a legacy VTK file's bytes (version 3.0, binary): a structured grid of points (x, y, z) in mm. Its
/// scalar `height_mm` shows as a relief in viewers.
std::string vtk(const Profile& map);

} // namespace rough
