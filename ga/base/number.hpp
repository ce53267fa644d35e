#pragma once

#include <charconv>
#include <string>

namespace ga {

/// A number as text: the shortest decimal that reads back as the same number.
inline std::string number(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

} // namespace ga
