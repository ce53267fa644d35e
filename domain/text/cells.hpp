#pragma once

#include "domain/text/words.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Lower case of ASCII letters; other bytes as they are.
std::string lower(std::string_view text);

/// Whether a word is one of those in a list that has a blank before and behind each.
bool is_in(std::string_view list, std::string_view word);

/// How a file writes its columns and numbers.
struct Dialect {
    /// What parts the columns; `comma_and_blank` is a comma with a blank behind it, where commas are decimal.
    enum class Separator { semicolon, tab, comma, comma_and_blank, blanks };
    Separator separator = Separator::blanks; ///< between columns
    bool decimal_comma = false;              ///< "0,5" is a half
};

/// A line has no more cells that anything reads.
constexpr std::size_t most_cells = 10'000'000;

/// The cells of a line, trimmed and without quotes; empty ones are kept, but those at the line's end are not.
/// Of a line with more than `most_cells` the first of them and one more are given.
std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator);

/// A cell's number, NaN where the cell says that the value is missing ("", NaN, BAD, --, …), and the value of
/// one unit in its last written digit.
struct Number {
    double value = 0;      ///< NaN: missing
    double last_digit = 0; ///< 0.001 of "1.234"
};

/// Nothing where the cell is neither a number nor a word for a missing one.
std::optional<Number> number(std::string_view cell, const Dialect& dialect);

} // namespace rough
