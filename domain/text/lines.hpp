#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// The lines of a text file as UTF-8, element i being line i + 1. Understands UTF-8 with or without its mark,
/// UTF-16 with its mark, and bytes that are no UTF-8 as Latin-1. A line ends with LF, CRLF, CRCRLF or a lone
/// CR. The typographic minus becomes '-' and the no-break space ' '. Throws InputError on binary content and
/// on more than 12 million lines.
std::vector<std::string> text_lines(const std::string& bytes, const std::string& file);

/// Throws InputError where a file that begins with these bytes holds no text: before all of a large one is
/// read.
void expect_text(std::string_view head, const std::string& file);

/// Where a message finds fault: "scan.txt, line 7"; the file alone where it has no lines (0).
std::string at(const std::string& file, int line);

} // namespace rough
