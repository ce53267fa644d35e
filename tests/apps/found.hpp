#pragma once

#include <regex>
#include <string>
#include <vector>

namespace app::testing {

/// The first group of each match of a regular expression in a text.
inline std::vector<std::string> found(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
        all.push_back((*i)[1]);
    return all;
}

} // namespace app::testing
