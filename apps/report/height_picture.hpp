#pragma once

#include "domain/profile/profile.hpp"

#include <string>

namespace app {

/// A map's heights as a PNG file's bytes: lowest dark blue, highest yellow, y upwards, a pixel a node or, of
/// more than 512 along a side, the mean of as many as it takes.
std::string height_png(const rough::Profile& map);

/// Bytes as an <img> element that holds them; `alt` says what there is to see.
std::string embedded(const std::string& png, const std::string& alt);

} // namespace app
