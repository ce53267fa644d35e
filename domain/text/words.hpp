#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Without white space at either end.
std::string_view trim(std::string_view text);

/// Lower case of ASCII letters; other bytes as they are.
std::string lower(std::string_view text);

/// Whether a word is one of those in a list that has a blank before and behind each.
bool is_in(std::string_view list, std::string_view word);

/// The parts of a text between its commas, trimmed; none of an empty text.
std::vector<std::string> listed(const std::string& text);

/// The finite number that is the whole of a word. Throws InputError that begins with `where`.
double number_from(const std::string& word, const std::string& where);

/// How a file writes its columns and numbers.
struct Dialect {
    /// What parts the columns; `comma_and_blank` is a comma with a blank behind it, where commas are decimal.
    enum class Separator { semicolon, tab, comma, comma_and_blank, blanks };
    Separator separator = Separator::blanks; ///< between columns
    bool decimal_comma = false;              ///< "0,5" is a half
};

/// Visits the cells of a line, trimmed and without quotes, until `visit` returns false; empty ones too,
/// except those at the line's end.
void for_each_cell(std::string_view line, Dialect::Separator separator,
                   const std::function<bool(std::string_view)>& visit);
/// The cells of a line as for_each_cell visits them.
std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator);

/// A cell's number and the value of one unit in its last written digit.
struct Number {
    double value = 0;      ///< NaN if the cell says that the value is missing ("", NaN, BAD, --, …)
    double last_digit = 0; ///< 0.001 of "1.234"
};
/// Nothing if the cell is neither a number nor a word for a missing one.
std::optional<Number> number(std::string_view cell, const Dialect& dialect);

} // namespace rough
