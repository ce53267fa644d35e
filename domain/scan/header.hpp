#pragma once

#include "domain/scan/table.hpp"
#include "domain/text/unit.hpp"

namespace rough {

/// A length in a header; the unit may be missing.
struct HeaderLength {
    double value = 0;               ///< in `unit`
    std::optional<LengthUnit> unit; ///< nothing if it is missing
    double rounding = 0;            ///< half of its last written digit, divided by the value
};

/// The statements of a file's header about its table.
struct Header {
    std::vector<std::optional<LengthUnit>> units; ///< one per column, if named above it
    std::vector<std::string> unknown_units;       ///< one per column: an unknown word in a unit's place, else ""
    std::vector<std::string> names;               ///< one per column, in lower case; empty if not named
    std::optional<LengthUnit> x_unit;             ///< a key such as "x-unit: um"
    std::optional<LengthUnit> y_unit;             ///< a key such as "y-unit: um"
    std::optional<LengthUnit> height_unit;        ///< a key such as "Value units: nm", "z-unit = nm", "Units: um"
    std::optional<HeaderLength> spacing;          ///< along x: "pixel size = 0.5 um", "dx: 0.5"
    std::optional<HeaderLength> row_spacing;      ///< along y: "dy: 0.5"; nothing if it is as along x
    std::optional<HeaderLength> width;            ///< "Width: 10 um": spacing x points of a row
    std::optional<HeaderLength> height;           ///< "Height: 10 um": row spacing x rows
    long columns = -1;                            ///< points of a row, "x-pixels = 256"; -1: not stated
    long rows = -1;                               ///< rows, "y-pixels = 256"; -1: not stated
    double height_factor = 1;                     ///< a key such as "height conversion factor (-> m) = 1e-9"
    bool validity_column = false;                 ///< a column "valid" of 0 and 1 follows the heights
};

/// Reads the lines before a table by one table of keys; a matrix of more than three columns counts as one
/// column. Throws InputError with file and line on a unit or factor that is not possible.
Header read_header(const Table& table, const std::string& file);

/// Whether a line states the spacing or the width, e.g. "dx: 0.5". The table then has one column.
bool names_spacing(std::string_view line);

} // namespace rough
