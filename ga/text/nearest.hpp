#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ga {

/// The distance of two words: the number of letters to insert, remove, change or exchange with their
/// neighbour (optimal string alignment; Damerau 1964).
std::size_t edits(const std::string& a, const std::string& b);

/// A hint at the end of a message about an unknown name: "; did you mean 'best'?". If no name is similar, it
/// lists the names.
std::string suggestion(const std::string& given, const std::vector<std::string>& names);

} // namespace ga
