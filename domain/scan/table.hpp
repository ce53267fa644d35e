#pragma once

#include "domain/text/unit.hpp"
#include "domain/text/words.hpp"

namespace rough {

/// A line of a file.
struct TextLine {
    int number = 0;        ///< from 1
    std::string_view text; ///< without its end
};

/// The numbers of a text file and the words before them.
struct Table {
    Dialect dialect;              ///< separator and decimal mark of the rows
    std::vector<TextLine> header; ///< lines before the numbers; comments included, without their mark
    std::size_t columns = 0;      ///< equal for all rows
    std::vector<Number> cells;    ///< row after row; NaN for a missing value
    std::vector<int> line;        ///< line number of each row
    long announced = -1;          ///< a single count of points before the rows; -1: none

    std::size_t rows() const { return line.size(); } ///< lines with numbers
    /// A cell; rows and columns count from 0.
    const Number& at(std::size_t row, std::size_t column) const { return cells[row * columns + column]; }
};

/// Finds the table in a file's lines, which must outlive the table, with the separator and decimal mark that
/// read the most rows. If every line is like "0,5", the table has one column if `one_column` is set,
/// otherwise two. In a table of up to three columns, a shorter row has missing values at its end. Throws
/// InputError with file and line on a line that is not a row and on a short row of a matrix. The limits are
/// 1e7 rows and 2e7 numbers.
Table read_table(const Lines& lines, const std::string& file, bool one_column);

/// A length in a header; the unit may be missing.
struct HeaderLength {
    double value = 0;               ///< in `unit`
    std::optional<LengthUnit> unit; ///< nothing if it is missing
};

/// The statements of a file's header about its table.
struct Header {
    std::vector<std::optional<LengthUnit>> units; ///< one per column, if named above it
    std::vector<std::string> unknown_units; ///< one per column: an unknown word in a unit's place, else ""
    std::optional<LengthUnit> x_unit;       ///< a key such as "x-unit: um"
    std::optional<LengthUnit> height_unit;  ///< a key such as "Value units: nm", "z-unit = nm", "Units: um"
    std::optional<HeaderLength> spacing;    ///< a key such as "pixel size = 0.5 um", "dx: 0.5"
    std::optional<HeaderLength> width;      ///< a key such as "Width: 10 um", all points: spacing x points
    double height_factor = 1;               ///< a key such as "height conversion factor (-> m) = 1e-9"
    bool validity_column = false;           ///< a column "valid" of 0 and 1 follows the heights
};

/// Reads the lines before a table; a matrix of more than three columns counts as one column. Throws
/// InputError with file and line on a unit or factor that is not possible.
Header read_header(const Table& table, const std::string& file);

/// Whether a line states the spacing or the width, e.g. "dx: 0.5". The table then has one column.
bool names_spacing(std::string_view line);

} // namespace rough
