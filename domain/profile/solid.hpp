#pragma once

#include "domain/profile/profile.hpp"

#include <string>

namespace rough {

/// A profile extruded to a solid that can be printed or meshed.
struct Extrusion {
    double width = 0;   ///< along the ridges, mm; 0: a quarter of the profile's length
    double base = 0;    ///< below the lowest node, mm; 0: the larger of the height range and a tenth of the
                        ///< length, unless single precision would lose the heights beside that
    double magnify = 1; ///< of all lengths, > 0
};

/// The solid as a binary STL file's bytes, in mm: x along the profile, y along the ridges, z up from the flat
/// underside. Closed, consistently oriented outwards, 8 (N-1) + 4 facets that share their vertices to the
/// bit. Throws InputError on lengths that are not above 0 or beyond single precision, and on nodes or heights
/// that it cannot tell apart.
std::string binary_stl(const Profile& profile, const Extrusion& extrusion = {});

} // namespace rough
