#pragma once

#include "domain/profile/profile.hpp"
#include "domain/scan/height_map.hpp"

#include <functional>

namespace rough {

/// Reads an X3P file (ISO 25178-72, ISO 5436-2): a zip archive of main.xml and, mostly, binary heights, x and
/// y incremental, lengths in metres. Throws InputError with one line where it cannot be read.
HeightMap read_x3p(const std::string& bytes, const std::string& file);

/// What main.xml describes; `entry` gives another entry of the archive, at most so many bytes of it. Throws
/// InputError as read_x3p.
HeightMap read_x3p_description(
    const std::string& xml,
    const std::function<std::optional<std::string>(const std::string& name, std::size_t most)>& entry,
    const std::string& file);

/// A profile or a map (mm) as the bytes of an X3P file: double precision, metres, with the standard's check
/// sums.
std::string x3p(const Profile& surface);

} // namespace rough
