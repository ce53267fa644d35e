#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Without white space at either end.
std::string_view trim(std::string_view text);

/// The parts of a text between its commas, trimmed; none of an empty text.
std::vector<std::string> listed(const std::string& text);

/// The finite number that is the whole of a word. Throws InputError that begins with `where`.
double number_from(const std::string& word, const std::string& where);

} // namespace rough
