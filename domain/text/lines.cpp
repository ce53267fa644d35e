#include "domain/text/lines.hpp"

#include "domain/errors.hpp"

#include <boost/locale/utf.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace rough {
namespace {

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

bool is_utf16(std::string_view bytes) {
    return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

std::string to_utf8(std::string bytes) {
    const auto byte = [](char c) { return static_cast<unsigned char>(c); };
    if (is_utf16(bytes)) {
        const std::size_t high = bytes[0] == '\xFE' ? 0 : 1; // place of a unit's high byte
        std::u16string units;
        for (std::size_t i = 2; i + 1 < bytes.size(); i += 2)
            units += static_cast<char16_t>(byte(bytes[i + high]) << 8 | byte(bytes[i + 1 - high]));
        return transcoded(units, [](char16_t) { return 0xFFFD; }); // half of a surrogate pair
    }
    if (std::all_of(bytes.begin(), bytes.end(), [&](char c) { return byte(c) < 0x80; }))
        return bytes;
    const std::size_t mark = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    return transcoded(std::string_view(bytes).substr(mark), byte); // other bytes are Latin-1
}

/// The kind of a binary file by its first bytes, in brackets; empty if it is not known.
std::string kind_of(std::string_view bytes) {
    using namespace std::string_view_literals;
    constexpr std::array<std::pair<std::string_view, const char*>, 5> kinds{
        {{"PK\x03\x04"sv, "a zip archive, as Excel workbooks are"},
         {"\xD0\xCF\x11\xE0"sv, "an old Office document"},
         {"GWYP"sv, "a Gwyddion file"},
         {"\x89HDF"sv, "an HDF5 file"},
         {"CDF"sv, "a NetCDF file"}}};
    for (const auto& [start, kind] : kinds)
        if (bytes.starts_with(start))
            return std::string(" (") + kind + ")";
    return "";
}

[[noreturn]] void refuse_binary(std::string_view bytes, const std::string& file) {
    throw InputError(file + ": holds binary data" + kind_of(bytes) +
                     "; give a text file of x and height (export as text or CSV)");
}

} // namespace

std::string at(const std::string& file, int line) {
    return line > 0 ? file + ", line " + std::to_string(line) : file;
}

void expect_text(std::string_view head, const std::string& file) {
    if (!is_utf16(head) && !head.starts_with("ISO 5436") && head.find('\0') != head.npos)
        refuse_binary(head, file);
}

Lines text_lines(std::string& bytes, const std::string& file) {
    bytes = to_utf8(std::move(bytes));
    if (bytes.starts_with("ISO 5436")) // softgauges end their fields with it
        std::replace(bytes.begin(), bytes.end(), '\0', ' ');
    if (bytes.find('\0') != std::string::npos)
        refuse_binary(bytes, file);
    const std::string_view text = bytes;
    std::vector<std::uint32_t> starts;
    for (std::size_t start = 0; start < text.size();) {
        std::size_t end = start; // std::string_view::find_first_of takes far longer
        while (end < text.size() && text[end] != '\n' && text[end] != '\r')
            ++end;
        if (starts.size() == max_lines)
            throw InputError(file + ": more than " + std::to_string(max_lines) +
                             " lines; give a smaller file");
        starts.push_back(static_cast<std::uint32_t>(start));
        const std::size_t next = std::min(text.find_first_not_of('\r', end), text.size());
        const bool carriage_returns_end_with_line_feed = next < text.size() && text[next] == '\n';
        start = carriage_returns_end_with_line_feed ? next + 1 : end + 1;
    }
    return {text, std::move(starts)};
}

} // namespace rough
