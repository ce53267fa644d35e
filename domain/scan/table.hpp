#pragma once

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
    std::size_t lone = 0;         ///< lines of one number before the rows: the count, or a length

    std::size_t rows() const { return line.size(); } ///< lines with numbers
    /// A cell; rows and columns count from 0.
    const Number& at(std::size_t row, std::size_t column) const { return cells[row * columns + column]; }
};

/// Finds the table in a file's lines, which must outlive the table, with the separator and decimal mark that read the
/// most rows. If every line is like "0,5", the table has one column if `one_column` is set, otherwise two. In a table
/// of up to three columns, a shorter row has missing values at its end. Throws InputError with file and line on a line
/// that is not a row and on a short row of a matrix. The limits are 1e7 rows and 2e7 numbers.
Table read_table(const Lines& lines, const std::string& file, bool one_column);

} // namespace rough
