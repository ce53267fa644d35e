#pragma once

#include <string>
#include <vector>

namespace rough {

/// A scan's points as the file gives them; NaN where a value is missing.
struct Points {
    /// Where a point lies along the scan, and its height; mm.
    std::vector<double> x, heights; ///< mm
    std::vector<double> last_digit; ///< one unit in x's last written digit, mm
    std::vector<int> line;          ///< of the file

    std::size_t size() const { return line.size(); } ///< points, missing ones too
};

/// Throws InputError naming the file and the first line with a missing value.
void refuse_missing(const Points& points, const std::string& file);

/// Points without gaps, and what that took.
struct Filled {
    Points points;            ///< evenly numbered, none missing
    std::size_t filled = 0;   ///< heights interpolated linearly between their neighbours
    std::size_t left_out = 0; ///< points without x, or without height at either end
};

/// Fills heights that are missing between two others; drops the rest.
Filled filled(const Points& points);

/// The same points in opposite order.
Points reversed(Points points);

} // namespace rough
