#pragma once

#include "domain/profile/profile.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace rough {

/// Sizes of the solid that is made from a surface, to be printed or meshed.
struct Extrusion {
    /// Size of a profile's solid in the second direction, mm. Default: a quarter of its length.
    std::optional<double> width = {};
    /// Thickness below the lowest node, mm. Default: the larger of the height range and a tenth of the
    /// length, or less so that single precision resolves the heights.
    std::optional<double> base = {};
    double magnify = 1;    ///< factor on all lengths, > 0
    double layer = 0.05;   ///< height of a printer's layers, mm; the solid does not depend on it
    bool periodic = false; ///< whether a map repeats beyond its length, so that it ends at the height it begins
};

/// A closed surface of triangles.
struct Mesh {
    std::vector<Eigen::Vector3f> vertices;            ///< positions of the corners, mm
    std::vector<std::array<std::uint32_t, 3>> facets; ///< indices of the corners, anticlockwise from outside
};

/// The solid under a profile that is extended in the second direction, or under a map. x is along the
/// profile, y in the second direction, z up from the flat underside; mm. It is closed, with facets oriented
/// outwards. C columns of R heights each give 2 C R vertices and 4 (C R - 1) facets. A profile has two rows.
/// A map of N_x x N_y nodes reaches over its cells to L_x x L_y. It has (N_x + 2) x (N_y + 2) heights, of
/// which the outer ones are at the edges. If it is periodic, it has (N_x + 1) x (N_y + 1).
///
/// Throws InputError on lengths that are not above 0, on a width for a map, and on lengths, nodes or
/// heights beyond single precision.
Mesh solid(const Profile& surface, const Extrusion& extrusion = {});

/// The solid as the bytes of a binary STL file, which has no unit. Throws as solid().
std::string binary_stl(const Profile& surface, const Extrusion& extrusion = {});

/// The solid as the bytes of a 3MF file (3MF Core 1.3), whose unit is the millimetre. Throws as solid().
std::string three_mf(const Profile& surface, const Extrusion& extrusion = {});

/// The heights of a surface as a picture, e.g. for a printer.
struct HeightImage {
    std::string png;                                   ///< bytes of the file, 16-bit greyscale
    std::vector<std::pair<std::string, double>> scale; ///< text chunks of the file: name and value
};

/// The picture of a map, or of a profile extended in the second direction like its solid. Heights are not magnified. x
/// is to the right and y upwards, as seen from above. The height (mm) of a pixel is lowest_height_mm + grey *
/// height_per_grey_mm, to half a grey level. Black (grey 0) is the lowest node and white (65535) the highest.
///
/// The text chunks have these two numbers, and spacing_mm and row_spacing_mm. Throws InputError on over 25
/// million pixels, or over a million along a side.
HeightImage height_image(const Profile& surface, const Extrusion& extrusion = {});

} // namespace rough
