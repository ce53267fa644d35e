#pragma once

#include "domain/numerics/grid.hpp"
#include "domain/scan/unit.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rough {

/// Heights at even points whose file says all about them in a layout of its own: rows along x, y growing
/// from row to row; a profile is a map of one row.
struct HeightMap {
    std::string format;               ///< e.g. "ISO 5436-2 (SMD)"
    double spacing = 0;               ///< of the points of a row, mm
    double row_spacing = 0;           ///< of the rows, mm; 0 of a profile
    Index rows = 1;                   ///< at least 1
    LengthUnit height_unit = {};      ///< as the file names it
    double height_factor = 1;         ///< a stored number times this is in `height_unit`
    std::vector<double> heights = {}; ///< row after row, as stored; NaN where none was measured
    std::vector<int> line = {};       ///< each height's in a text file; empty of a binary one
    long announced = -1;              ///< how many heights the file says it has; -1: it does not

    /// Points of a row.
    Index columns() const { return static_cast<Index>(heights.size()) / rows; }
};

/// The value that stands for "not measured" among numbers of a type, by ISO 25178-71's number of the type (0
/// to 7: uint8, uint16, uint32, float, int8, int16, int32, double); NaN where the type has none.
double missing_mark(int type);

/// Whether a file that begins with these bytes is one that binary_map reads.
bool is_binary_map(std::string_view head);
/// Reads binary surface data files (ISO 25178-71 SDF, BCR), Digital Surf's SUR and PRO (not compressed),
/// Gwyddion's simple field (GSF) and X3P (ISO 25178-72); nothing where the bytes begin as none of these.
/// Sizes are held against the bytes that are there before anything is allocated. Throws InputError with one
/// line on a file that cannot be read.
std::optional<HeightMap> binary_map(const std::string& bytes, const std::string& file);

} // namespace rough
