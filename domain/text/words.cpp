#include "domain/text/words.hpp"

#include "domain/errors.hpp"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/locale/utf.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

namespace rough {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// The end of the cell that begins at `start`, and the start of the next one.
std::pair<std::size_t, std::size_t> cell_end(std::string_view line, std::size_t start, Dialect::Separator separator) {
    using enum Dialect::Separator;
    std::size_t end = 0;
    if (separator == blanks) {
        for (end = start; end < line.size() && !is_blank(line[end]);) ++end;
        std::size_t next = end;
        while (next < line.size() && is_blank(line[next])) ++next;
        return {end, next};
    }
    end = line.find(separator == semicolon ? ';' : separator == tab ? '\t' : ',', start);
    while (separator == comma_and_blank && end != line.npos && end + 1 < line.size() && !is_blank(line[end + 1]))
        end = line.find(',', end + 1);
    end = std::min(end, line.size());
    return {end, end + 1};
}

bool digit(char c) { return c >= '0' && c <= '9'; }

bool says_missing(std::string_view cell) {
    constexpr std::array<std::string_view, 23> words{
        "",    "nan",  "-nan",    "na",      "n/a",     "#n/a",    "null", "none", "bad", "-",    "--",      "---",
        "inf", "-inf", "1.#qnan", "-1.#ind", "missing", "invalid", "*",    "***",  "?",   "n.a.", "nan(ind)"};
    constexpr std::size_t longest = 8;
    return cell.size() <= longest && std::find(words.begin(), words.end(), lower(cell)) != words.end();
}

constexpr std::size_t max_lines = 12'000'000; // a table of 1e7 rows and its header

/// Units of UTF-8 or UTF-16 as UTF-8. A unit outside any character becomes the code `replace(unit)`.
template <class Units, class Replace>
std::string transcoded(const Units& units, Replace replace) {
    namespace utf = boost::locale::utf;
    std::string text;
    text.reserve(units.size());
    for (auto at = units.begin(); at != units.end();) {
        auto next = at;
        utf::code_point code = utf::utf_traits<typename Units::value_type>::decode(next, units.end());
        if (!utf::is_valid_codepoint(code)) {
            code = replace(*at);
            next = at + 1;
        }
        if (code == 0xA0 || code == 0x202F)
            code = ' ';
        else if (code == 0x2212)
            code = '-';
        utf::utf_traits<char>::encode(code, std::back_inserter(text));
        at = next;
    }
    return text;
}

bool is_utf16(std::string_view bytes) { return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"); }

std::string to_utf8(std::string bytes) {
    const auto byte = [](char c) { return static_cast<unsigned char>(c); };
    if (is_utf16(bytes)) {
        const std::size_t high = bytes[0] == '\xFE' ? 0 : 1; // place of a unit's high byte
        std::u16string units;
        for (std::size_t i = 2; i + 1 < bytes.size(); i += 2)
            units += static_cast<char16_t>(byte(bytes[i + high]) << 8 | byte(bytes[i + 1 - high]));
        return transcoded(units, [](char16_t) { return 0xFFFDu; }); // half of a surrogate pair
    }
    if (std::all_of(bytes.begin(), bytes.end(), [&](char c) { return byte(c) < 0x80; })) return bytes;
    const std::size_t mark = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    return transcoded(std::string_view(bytes).substr(mark), byte); // other bytes are Latin-1
}

/// The kind of a binary file by its first bytes, in brackets; empty if it is not known.
std::string kind_of(std::string_view bytes) {
    using namespace std::string_view_literals;
    constexpr std::array<std::pair<std::string_view, const char*>, 15> kinds{
        {{"PK\x03\x04"sv, "a zip archive"},
         {"\xD0\xCF\x11\xE0"sv, "an old Office document"},
         {"\x89HDF"sv, "an HDF5 file, as Zygo's DATX"},
         {"CDF"sv, "a NetCDF file"},
         {"\x88\x1B\x03"sv, "a Zygo MetroPro file, DAT"},
         {"\x01\0Directory"sv, "a Wyko file, OPD"},
         {"AliconaImaging"sv, "an Alicona file, AL3D"},
         {"VK4_"sv, "a Keyence file, VK4"},
         {"VK6"sv, "a Keyence file, VK6"},
         {"KPK"sv, "a Keyence file, ZON"},
         {"Binary TrueMap"sv, "a TrueMap file, TMD"},
         {"FRTM_GLIDER"sv, "an FRT file"},
         {"fileformat = bcr"sv, "a BCR-STM file of SPIP, BCRF"},
         {"II*\0"sv, "a TIFF image"},
         {"MATLAB"sv, "a MATLAB file"}}};
    for (const auto& [start, kind] : kinds)
        if (bytes.starts_with(start)) return std::string(" (") + kind + ")";
    return "";
}

[[noreturn]] void refuse_binary(std::string_view bytes, const std::string& file) {
    throw InputError(file + ": holds binary data" + kind_of(bytes) +
                     "; export it as X3P, SDF or text with the instrument's program or Gwyddion");
}

} // namespace

std::string_view trim(std::string_view text) {
    return boost::algorithm::trim_copy_if(text, [](char c) { return is_blank(c) || c == '\r' || c == '\n'; });
}

std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');) parts.emplace_back(trim(part));
    return parts;
}

double number_from(const std::string& word, const std::string& where) {
    const auto read = number(word, Dialect{});
    if (!read || std::isnan(read->value))
        throw InputError(where + ": \"" + word + "\" is not a finite number; give one");
    return read->value;
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
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = trim(cell.substr(1, cell.size() - 2));
        start = next;
        if (cell.empty()) {
            ++empty;
            continue;
        }
        for (; empty > 0; --empty)
            if (!visit({})) return;
        if (!visit(cell)) return;
    }
}

std::vector<std::string_view> split(std::string_view line, Dialect::Separator separator) {
    std::vector<std::string_view> cells;
    for_each_cell(line, separator, [&](std::string_view cell) { return cells.push_back(cell), true; });
    return cells;
}

std::optional<Number> number(std::string_view cell, const Dialect& dialect) {
    const auto not_a_number = [&]() -> std::optional<Number> {
        if (says_missing(cell)) return Number{std::numeric_limits<double>::quiet_NaN(), 0};
        return std::nullopt;
    };
    std::string_view text = cell.substr(cell.starts_with('+') ? 1 : 0);
    if (text.empty() || !(digit(text[0]) || text[0] == '-' || text[0] == '.')) return not_a_number();
    // If commas separate, a cell "05" is the fraction of a number with a decimal comma.
    if (dialect.separator == Dialect::Separator::comma && text.size() > 1 && text[0] == '0' && digit(text[1]))
        return std::nullopt;
    std::size_t point = text.find(dialect.decimal_comma ? ',' : '.');
    std::string with_point;
    if (dialect.decimal_comma) {
        if (text.find('.') != text.npos) return not_a_number();
        if (point != text.npos) {
            if (point + 1 == text.size() || !digit(text[point + 1])) return std::nullopt;
            with_point = text;
            with_point[point] = '.';
            text = with_point;
        }
    }
    Number result;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, result.value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(result.value)) return not_a_number();
    const std::size_t exponent = std::min({text.find('e'), text.find('E'), text.size()});
    int power = 0;
    if (exponent + 1 < text.size()) {
        const char* const first = text.data() + exponent + (text[exponent + 1] == '+' ? 2 : 1);
        std::from_chars(first, end, power);
    }
    const int decimals = point < exponent ? static_cast<int>(exponent - point - 1) : 0;
    result.last_place = std::clamp(power, -1000, 1000) - decimals;
    return result;
}

std::string at(const std::string& file, int line) { return line > 0 ? file + ", line " + std::to_string(line) : file; }

void expect_text(std::string_view head, const std::string& file) {
    if (!is_utf16(head) && !head.starts_with("ISO 5436") && head.find('\0') != head.npos) refuse_binary(head, file);
}

Lines text_lines(std::string& bytes, const std::string& file) {
    bytes = to_utf8(std::move(bytes));
    if (bytes.starts_with("ISO 5436")) // softgauges end their fields with it
        std::replace(bytes.begin(), bytes.end(), '\0', ' ');
    if (bytes.find('\0') != std::string::npos) refuse_binary(bytes, file);
    const std::string_view text = bytes;
    std::vector<std::uint32_t> starts;
    for (std::size_t start = 0; start < text.size();) {
        std::size_t end = start; // std::string_view::find_first_of takes far longer
        while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
        if (starts.size() == max_lines)
            throw InputError(file + ": more than " + std::to_string(max_lines) + " lines; give a smaller file");
        starts.push_back(static_cast<std::uint32_t>(start));
        const std::size_t next = std::min(text.find_first_not_of('\r', end), text.size());
        const bool carriage_returns_end_with_line_feed = next < text.size() && text[next] == '\n';
        start = carriage_returns_end_with_line_feed ? next + 1 : end + 1;
    }
    return {text, std::move(starts)};
}

} // namespace rough
