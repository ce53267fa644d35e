#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// The lines of a text file: views into `bytes`, which becomes UTF-8. Element i is line i + 1. Reads UTF-8
/// with or without its mark and UTF-16 with its mark; bytes outside UTF-8 are read as Latin-1. A line ends
/// with LF, CRLF, CRCRLF or a lone CR. The typographic minus becomes '-' and the no-break space ' '. Throws
/// InputError on binary content and on more than 12 million lines.
std::vector<std::string_view> text_lines(std::string& bytes, const std::string& file);

/// Throws InputError if a file that begins with these bytes is binary, before a large file is read
/// completely.
void expect_text(std::string_view head, const std::string& file);

/// The place that a message names: "scan.txt, line 7", or only the file if `line` is 0.
std::string at(const std::string& file, int line);

} // namespace rough
