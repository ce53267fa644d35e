#pragma once

#include "domain/scan/unit.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rough {

/// A profile whose file says all about it in a layout of its own: heights at even points.
struct NamedProfile {
    std::string format;          ///< e.g. "ISO 5436-2 (SMD)"
    double spacing = 0;          ///< mm
    LengthUnit height_unit;      ///< as the file names it
    double height_factor = 1;    ///< a stored number times this is in `height_unit`
    std::vector<double> heights; ///< as stored; NaN where the file says that none was measured
    std::vector<int> line;       ///< each height's
    long announced = -1;         ///< how many heights the file says it has; -1: it does not
};

/// Reads ASCII surface data files of one profile (ISO 25178-71 SDF, BCR), softgauges (ISO 5436-2 SMD),
/// Talysurf's PRF (as NPL's softgauges have it), PTB's PR, and SigmaSurf's data files; nothing where the
/// lines are none of these. Throws InputError naming file and line on one that cannot be read as a profile.
std::optional<NamedProfile> named_profile(const std::vector<std::string>& lines, const std::string& file);

} // namespace rough
