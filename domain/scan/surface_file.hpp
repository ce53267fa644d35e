#pragma once

#include "domain/scan/map.hpp"

namespace rough {

/// Even nodes near to given places, and their distance from them.
struct Evenness {
    double first = 0;     ///< the first even node, mm
    double spacing = 0;   ///< least-squares spacing, mm
    double deviation = 0; ///< largest distance of a place from its even node, mm
    bool even = false;    ///< each place is within 1e-3 spacings, or its rounding, of its node
};

/// Fits even nodes to two or more increasing places by least squares over the index. Rounding by up to an
/// eighth of the spacing is accepted.
Evenness evenness(const std::vector<double>& places, const Rounding& rounding);

/// Reads the heights of any known format as a map, or as a profile (`as_map` false; a map then needs a row in
/// the options). Decides format, units, missing points (NaN) and axes, and compares them with given ones. The
/// result's heights are in mm, its factor is 1. Throws InputError with one line.
HeightMap read_heights(const std::filesystem::path& path, const ScanOptions& options, bool as_map);

} // namespace rough
