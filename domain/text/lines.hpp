#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rough {

/// The lines of a text. Only their starts are stored, because a list of views would take four times the
/// memory.
class Lines {
  public:
    /// `text` must outlive the lines. Each one begins at a start and ends before its line breaks.
    Lines(std::string_view text, std::vector<std::uint32_t> starts)
        : text_(text), starts_(std::move(starts)) {}
    std::size_t size() const { return starts_.size(); } ///< number of lines
    /// Line i + 1, without its end.
    std::string_view operator[](std::size_t i) const {
        const std::size_t end = i + 1 < starts_.size() ? starts_[i + 1] : text_.size();
        const std::string_view line = text_.substr(starts_[i], end - starts_[i]);
        return line.substr(0, line.find_last_not_of("\r\n") + 1); // npos + 1 is 0
    }

    /// Visits the lines in their order.
    struct Iterator {
        const Lines* lines;                                         ///< all
        std::size_t at;                                             ///< index of the current one
        std::string_view operator*() const { return (*lines)[at]; } ///< the current line
        Iterator& operator++() { return ++at, *this; }              ///< goes to the next one
        bool operator==(const Iterator&) const = default;           ///< at the same line
    };
    Iterator begin() const { return {this, 0}; }    ///< the first line
    Iterator end() const { return {this, size()}; } ///< after the last line

  private:
    std::string_view text_;
    std::vector<std::uint32_t> starts_;
};

/// The lines of a text file in `bytes`, which becomes UTF-8 and must outlive them. Reads UTF-8
/// with or without its mark and UTF-16 with its mark; bytes outside UTF-8 are read as Latin-1. A line ends
/// with LF, CRLF, CRCRLF or a lone CR. The typographic minus becomes '-' and the no-break space ' '. Throws
/// InputError on binary content and on more than 12 million lines.
Lines text_lines(std::string& bytes, const std::string& file);

/// Throws InputError if a file that begins with these bytes is binary, before a large file is read
/// completely.
void expect_text(std::string_view head, const std::string& file);

/// The place in a message: "scan.txt, line 7", or only the file if `line` is 0.
std::string at(const std::string& file, int line);

} // namespace rough
