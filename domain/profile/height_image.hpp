#pragma once

#include "domain/profile/solid.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rough {

/// The heights of a surface as a picture, e.g. for a printer.
struct HeightImage {
    std::string png;                                   ///< bytes of the file, 16-bit greyscale
    std::vector<std::pair<std::string, double>> scale; ///< text chunks of the file: name and value
};

/// The heights of a map, or of a profile extended in the second direction by width_of(), without
/// magnification. x is to the right and y upwards, as seen from above. A height (mm) is lowest_height_mm +
/// grey height_per_grey_mm, to half a grey level. Black (0) is the lowest node and white (65535) the highest.
/// The scale also has spacing_mm and row_spacing_mm. Throws InputError on over 25 million pixels, or a
/// million along a side.
HeightImage height_image(const Profile& surface, const Extrusion& extrusion = {});

} // namespace rough
