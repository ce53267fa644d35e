#include "domain/text/words.hpp"

#include "domain/errors.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

namespace rough {

std::string_view trim(std::string_view text) {
    constexpr std::string_view blank = " \t\v\f\r\n";
    const std::size_t first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');)
        parts.emplace_back(trim(part));
    return parts;
}

double number_from(const std::string& word, const std::string& where) {
    double value = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
        throw InputError(where + ": \"" + word + "\" given, expected a finite number");
    return value;
}

} // namespace rough
