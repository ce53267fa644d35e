#pragma once

#include "domain/text/cells.hpp"

#include <string>
#include <vector>

namespace rough {

/// A line of a file.
struct TextLine {
    int number = 0;   ///< from 1, as an editor counts
    std::string text; ///< without its end
};

/// The numbers of a text file and the words before them.
struct Table {
    Dialect dialect;              ///< of the rows
    std::vector<TextLine> header; ///< what stands before the numbers, comments included, their mark removed
    std::size_t columns = 0;      ///< the same for every row
    std::vector<std::vector<Number>> column; ///< columns x rows; a missing value is NaN
    std::vector<int> line;                   ///< each row's line
    long announced = -1;                     ///< a lone count of points before the rows; -1: none

    std::size_t rows() const { return line.size(); } ///< lines with numbers
};

/// Finds the table in a file's lines: separators ; tab , and blanks, decimal points or commas, whichever read
/// the most rows. "0,5" alone on every line is one column when `one_column` is set, else two. Comments (# % !
/// // *) and blank lines are skipped, trailing separators ignored, a row with fewer cells than the others has
/// missing values at its end. Throws InputError naming file and line on a row that is no row.
Table read_table(const std::vector<std::string>& lines, const std::string& file, bool one_column);

} // namespace rough
