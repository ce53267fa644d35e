#pragma once

#include "domain/scan/table.hpp"
#include "domain/scan/unit.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rough {

/// A length as a header gives it; the unit may be missing.
struct HeaderLength {
    double value = 0;               ///< in `unit`
    std::optional<LengthUnit> unit; ///< none: not said
};

/// What a file's header says about its table.
struct Header {
    std::vector<std::optional<LengthUnit>> units; ///< one a column, where named above it
    std::vector<std::string> unknown_units;       ///< one a column: what stands where a unit does; "" nothing
    std::optional<LengthUnit> x_unit;             ///< by key: "x-unit: um"
    std::optional<LengthUnit> height_unit;        ///< by key: "Value units: nm", "z-unit = nm", "Units: um"
    std::optional<HeaderLength> spacing;          ///< by key: "pixel size = 0.5 um", "dx: 0.5"
    std::optional<HeaderLength> width; ///< by key: "Width: 10 um", of all points, so spacing x points
    double height_factor = 1;          ///< by key: "height conversion factor (-> m) = 1e-9"
    bool validity_column = false;      ///< a column named "valid" of 0 and 1 follows the heights
};

/// Reads the lines before a table of `columns` columns. Throws InputError naming file and line on what it
/// cannot mean.
Header read_header(const std::vector<TextLine>& lines, const Dialect& dialect, std::size_t columns,
                   const std::string& file);

/// Whether a line gives the points' distance by key, so that the table has one column.
bool names_spacing(const std::string& line);

} // namespace rough
