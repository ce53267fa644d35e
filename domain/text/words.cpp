#include "domain/text/words.hpp"

#include "domain/errors.hpp"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

namespace rough {
namespace {

constexpr std::string_view blank = " \t\v\f";

/// The end of the cell that begins at `start`, and the start of the next one.
std::pair<std::size_t, std::size_t> cell_end(std::string_view line, std::size_t start,
                                             Dialect::Separator separator) {
    using enum Dialect::Separator;
    std::size_t end = 0;
    if (separator == blanks) {
        end = std::min(line.find_first_of(blank, start), line.size());
        return {end, std::min(line.find_first_not_of(blank, end), line.size())};
    }
    end = line.find(separator == semicolon ? ';' : separator == tab ? '\t' : ',', start);
    while (separator == comma_and_blank && end != line.npos && end + 1 < line.size() &&
           blank.find(line[end + 1]) == blank.npos)
        end = line.find(',', end + 1);
    end = std::min(end, line.size());
    return {end, end + 1};
}

bool digit(char c) { return c >= '0' && c <= '9'; }

bool says_missing(std::string_view cell) {
    constexpr std::array<std::string_view, 23> words{
        "",        "nan",     "-nan", "na",  "n/a", "#n/a", "null",    "none",
        "bad",     "-",       "--",   "---", "inf", "-inf", "1.#qnan", "-1.#ind",
        "missing", "invalid", "*",    "***", "?",   "n.a.", "nan(ind)"};
    return std::find(words.begin(), words.end(), lower(cell)) != words.end();
}

} // namespace

std::string_view trim(std::string_view text) {
    constexpr std::string_view ends = " \t\v\f\r\n";
    const std::size_t first = text.find_first_not_of(ends);
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(ends) - first + 1);
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
        throw InputError(where + ": \"" + word + "\" is not a finite number; give one");
    return value;
}

std::string lower(std::string_view text) {
    return boost::algorithm::to_lower_copy(std::string(text), std::locale::classic());
}

bool is_in(std::string_view list, std::string_view word) {
    return !word.empty() && word.find(' ') == std::string_view::npos &&
           list.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

void for_each_cell(std::string_view line, Dialect::Separator separator,
                   const std::function<bool(std::string_view)>& visit) {
    line = trim(line);
    std::size_t empty = 0; // empty cells that no other cell has followed yet
    for (std::size_t start = 0; start < line.size();) {
        const auto [end, next] = cell_end(line, start, separator);
        std::string_view cell = trim(line.substr(start, end - start));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = trim(cell.substr(1, cell.size() - 2));
        start = next;
        if (cell.empty()) {
            ++empty;
            continue;
        }
        for (; empty > 0; --empty)
            if (!visit({}))
                return;
        if (!visit(cell))
            return;
    }
}

std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator) {
    std::vector<std::string_view> cells;
    for_each_cell(line, separator, [&](std::string_view cell) { return cells.push_back(cell), true; });
    return cells;
}

std::optional<Number> number(std::string_view cell, const Dialect& dialect) {
    if (says_missing(cell))
        return Number{std::numeric_limits<double>::quiet_NaN(), 0};
    std::string text(cell.substr(cell.starts_with('+') ? 1 : 0));
    // If commas separate, a cell "05" is the fraction of a number with a decimal comma.
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
