#pragma once

#include <regex>
#include <string>
#include <vector>

namespace app::testing {

/// What the first group of a regular expression holds at each of its places in a text.
inline std::vector<std::string> found(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
        all.push_back((*i)[1]);
    return all;
}

/// A page's sections, figures and tables in order: "# heading", "figure id", "table caption".
inline std::vector<std::string> outline(const std::string& html) {
    const std::regex part("<h2 [^>]*>([^<]*)</h2>|<figure id=\"([^\"]*)\"|<table>(?:<caption>([^<]*))?");
    std::vector<std::string> all;
    for (std::sregex_iterator i(html.begin(), html.end(), part), end; i != end; ++i)
        all.push_back((*i)[1].matched ? "# " + (*i)[1].str()
                      : (*i)[2].matched
                          ? "figure " + (*i)[2].str()
                          : "table " + std::regex_replace((*i)[3].str(), std::regex("\\s+"), " "));
    return all;
}

using Outline = std::vector<std::string>;

} // namespace app::testing
