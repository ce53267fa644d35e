#include "domain/text/cells.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace rough {
namespace {

constexpr std::string_view blank = " \t\v\f";

bool digit(char c) { return c >= '0' && c <= '9'; }

bool says_missing(std::string_view cell) {
    constexpr std::array<std::string_view, 23> words{
        "",        "nan",     "-nan", "na",  "n/a", "#n/a", "null",    "none",
        "bad",     "-",       "--",   "---", "inf", "-inf", "1.#qnan", "-1.#ind",
        "missing", "invalid", "*",    "***", "?",   "n.a.", "nan(ind)"};
    return std::find(words.begin(), words.end(), lower(cell)) != words.end();
}

} // namespace

std::string lower(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return small;
}

bool is_in(std::string_view list, std::string_view word) {
    return !word.empty() && word.find(' ') == std::string_view::npos &&
           list.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator) {
    using enum Dialect::Separator;
    std::vector<std::string_view> cells;
    line = trim(line);
    const auto add = [&](std::string_view cell) {
        cell = trim(cell);
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = trim(cell.substr(1, cell.size() - 2));
        cells.push_back(cell);
    };
    std::size_t start = 0;
    while (start < line.size() && cells.size() <= most_cells) {
        std::size_t end = start;
        std::size_t next = start;
        if (separator == blanks) {
            end = std::min(line.find_first_of(blank, start), line.size());
            next = std::min(line.find_first_not_of(blank, end), line.size());
        } else if (separator == comma_and_blank) {
            end = line.find(',', start);
            while (end != std::string_view::npos && end + 1 < line.size() &&
                   blank.find(line[end + 1]) == blank.npos)
                end = line.find(',', end + 1);
            end = std::min(end, line.size());
            next = end + 1;
        } else {
            end = std::min(line.find(separator == semicolon ? ';'
                                     : separator == tab     ? '\t'
                                                            : ',',
                                     start),
                           line.size());
            next = end + 1;
        }
        add(line.substr(start, end - start));
        start = next;
    }
    while (!cells.empty() && cells.back().empty())
        cells.pop_back();
    return cells;
}

std::optional<Number> number(std::string_view cell, const Dialect& dialect) {
    if (says_missing(cell))
        return Number{std::numeric_limits<double>::quiet_NaN(), 0};
    std::string text(cell.substr(cell.starts_with('+') ? 1 : 0));
    // Between commas, 0 followed by a digit is the fraction of a number with a decimal comma.
    if (dialect.separator == Dialect::Separator::comma && text.size() > 1 && text[0] == '0' && digit(text[1]))
        return std::nullopt;
    std::size_t point = text.find('.');
    if (dialect.decimal_comma) {
        if (point != std::string::npos)
            return std::nullopt;
        point = text.find(',');
        if (point != std::string::npos)
            text[point] = '.';
        if (point != std::string::npos && (point + 1 == text.size() || !digit(text[point + 1])))
            return std::nullopt;
    }
    if (text.empty() || !(digit(text[0]) || text[0] == '-' || text[0] == '.'))
        return std::nullopt;
    Number result;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, result.value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(result.value))
        return std::nullopt;
    const std::size_t exponent = std::min(text.find_first_of("eE"), text.size());
    int power = 0;
    if (exponent + 1 < text.size()) {
        const char* const first = text.data() + exponent + (text[exponent + 1] == '+' ? 2 : 1);
        std::from_chars(first, end, power);
    }
    const int decimals = point < exponent ? static_cast<int>(exponent - point - 1) : 0;
    result.last_digit = std::pow(10., static_cast<double>(power) - decimals);
    return result;
}

} // namespace rough
