#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rough {

/// The text without white space at its ends.
std::string_view trim(std::string_view text);

/// The text with ASCII letters in lower case.
std::string lower(std::string_view text);

/// Whether a word is in a list. Each word of the list has a blank before and after it.
bool is_in(std::string_view list, std::string_view word);

/// The trimmed parts of a text between its commas; none if the text is empty.
std::vector<std::string> listed(const std::string& text);

/// The member `name` of each row, or the keys of a map.
template <class Rows>
std::vector<std::string> names_of(const Rows& rows) {
    std::vector<std::string> names;
    for (const auto& row : rows)
        if constexpr (requires { row.name; })
            names.push_back(row.name);
        else
            names.push_back(row.first);
    return names;
}

/// A word as a finite number. Throws InputError that begins with `where` for any other word.
double number_from(const std::string& word, const std::string& where);

/// The separator and decimal mark of a file.
struct Dialect {
    /// Separates the columns. `comma_and_blank` is a comma before a blank; other commas are then decimal.
    enum class Separator { semicolon, tab, comma, comma_and_blank, blanks };
    Separator separator = Separator::blanks; ///< between columns
    bool decimal_comma = false;              ///< "0,5" is a half
};

/// Visits a line's cells, trimmed and unquoted, until `visit` returns false; empty ones except at the end.
void for_each_cell(std::string_view line, Dialect::Separator separator,
                   const std::function<bool(std::string_view)>& visit);
/// The cells of a line as for_each_cell visits them.
std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator);

/// A cell's number and the place of its last written digit.
struct Number {
    double value = 0;   ///< NaN if the cell says that the value is missing ("", NaN, BAD, --, …)
    int last_place = 0; ///< power of ten of the last digit: -3 for "1.234"
};
/// A cell as a number; nothing if it is neither a number nor a word for a missing value.
std::optional<Number> number(std::string_view cell, const Dialect& dialect);

/// The lines of a text. It stores only their starts; a list of views would take four times the memory.
class Lines {
  public:
    /// `text` must outlive the lines. Each one begins at a start and ends before its line breaks.
    Lines(std::string_view text, std::vector<std::uint32_t> starts) : text_(text), starts_(std::move(starts)) {}
    std::size_t size() const { return starts_.size(); } ///< number of lines
    /// Line i + 1, without its end.
    std::string_view operator[](std::size_t i) const {
        const std::size_t end = i + 1 < starts_.size() ? starts_[i + 1] : text_.size();
        const std::string_view line = text_.substr(starts_[i], end - starts_[i]);
        return line.substr(0, line.find_last_not_of("\r\n") + 1); // npos + 1 is 0
    }

  private:
    std::string_view text_;
    std::vector<std::uint32_t> starts_;
};

/// The lines of a text file in `bytes`, which becomes UTF-8 and must outlive them. Reads UTF-8
/// with or without its mark and UTF-16 with its mark; bytes outside UTF-8 are read as Latin-1. A line ends
/// with LF, CRLF, CRCRLF or a lone CR. The typographic minus becomes '-' and the no-break space ' '. Throws
/// InputError on binary content and on more than 12 million lines.
Lines text_lines(std::string& bytes, const std::string& file);

/// Throws InputError if a file that begins with these bytes is binary, before all of it is read.
void expect_text(std::string_view head, const std::string& file);

/// The place in a message: "scan.txt, line 7", or only the file if `line` is 0.
std::string at(const std::string& file, int line);

} // namespace rough
