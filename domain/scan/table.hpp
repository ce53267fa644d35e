#pragma once

#include "domain/scan/unit.hpp"
#include "domain/text/words.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rough {

/// A line of a file.
struct TextLine {
    int number = 0;        ///< from 1, as an editor counts
    std::string_view text; ///< without its end
};

/// The numbers of a text file and the words before them.
struct Table {
    Dialect dialect;              ///< of the rows
    std::vector<TextLine> header; ///< what stands before the numbers, comments included, their mark removed
    std::size_t columns = 0;      ///< the same for every row
    std::vector<Number> cells;    ///< row after row; a missing value is NaN
    std::vector<int> line;        ///< each row's line
    long announced = -1;          ///< a lone count of points before the rows; -1: none

    std::size_t rows() const { return line.size(); } ///< lines with numbers
    const Number& at(std::size_t row, std::size_t column) const {
        return cells[row * columns + column];
    } ///< a cell
};

/// Finds the table in a file's lines, which must outlive it: separators ; tab , and blanks, decimal points or
/// commas, whichever read the most rows. "0,5" alone on every line is one column if `one_column` is set, else
/// two. Comments (# % ! // *) and blank lines are skipped, trailing separators ignored. In a table of up to
/// three columns a row with fewer cells than the others has missing values at its end. Throws InputError
/// naming file and line on a row that is no row, on a short row of a matrix, on more than 1e7 rows and on
/// more than 2e7 numbers.
Table read_table(const std::vector<std::string_view>& lines, const std::string& file, bool one_column);

/// A length as a header gives it; the unit may be missing.
struct HeaderLength {
    double value = 0;               ///< in `unit`
    std::optional<LengthUnit> unit; ///< none: not said
};

/// What a file's header says about its table.
struct Header {
    std::vector<std::optional<LengthUnit>> units; ///< one per column, if named above it
    std::vector<std::string> unknown_units; ///< one per column: what stands in a unit's place; "" nothing
    std::optional<LengthUnit> x_unit;       ///< by key: "x-unit: um"
    std::optional<LengthUnit> height_unit;  ///< by key: "Value units: nm", "z-unit = nm", "Units: um"
    std::optional<HeaderLength> spacing;    ///< by key: "pixel size = 0.5 um", "dx: 0.5"
    std::optional<HeaderLength> width;      ///< by key: "Width: 10 um", of all points, so spacing x points
    double height_factor = 1;               ///< by key: "height conversion factor (-> m) = 1e-9"
    bool validity_column = false;           ///< a column named "valid" of 0 and 1 follows the heights
};

/// Reads the lines before a table; a matrix of more than three columns counts as one column. Throws
/// InputError naming file and line on what it cannot mean.
Header read_header(const Table& table, const std::string& file);

/// Whether a line gives the points' distance by key, so that the table has one column.
bool names_spacing(std::string_view line);

} // namespace rough
