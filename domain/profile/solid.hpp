#pragma once

#include "domain/profile/profile.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rough {

/// A profile extruded to a solid that can be printed or meshed.
struct Extrusion {
    double width = 0;   ///< along the ridges, mm; 0: a quarter of the profile's length
    double base = 0;    ///< below the lowest node, mm; 0: the larger of the height range and a tenth of the
                        ///< length, unless single precision would lose the heights beside that
    double magnify = 1; ///< of all lengths, > 0
};

/// A closed surface of triangles.
struct Mesh {
    std::vector<Eigen::Vector3f> vertices;            ///< mm
    std::vector<std::array<std::uint32_t, 3>> facets; ///< its corners, turning left seen from outside
};

/// The solid's surface in mm: x along the profile, y along the ridges, z up from the flat underside. Closed,
/// consistently oriented outwards, 4 N vertices and 8 (N-1) + 4 facets. Throws InputError on lengths that are
/// not above 0 or beyond single precision, and on nodes or heights that it cannot tell apart.
Mesh extruded(const Profile& profile, const Extrusion& extrusion = {});

/// The solid as a binary STL file's bytes, which name no unit; throws as extruded().
std::string binary_stl(const Profile& profile, const Extrusion& extrusion = {});

/// The solid as a 3MF file's bytes (3MF Core 1.3), which say that lengths are millimetres; throws as
/// extruded().
std::string three_mf(const Profile& profile, const Extrusion& extrusion = {});

} // namespace rough
