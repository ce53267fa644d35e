#include "domain/text/lines.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace rough {
namespace {

constexpr std::size_t max_lines = 12'000'000; // a table of 1e7 rows and its header

void append_utf8(std::string& text, std::uint32_t code) {
    if (code == 0xA0 || code == 0x202F)
        code = ' ';
    else if (code == 0x2212)
        code = '-';
    const auto tail = [&](int shift) { text += static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0 | (code >> 6));
        tail(0);
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0 | (code >> 12));
        tail(6), tail(0);
    } else {
        text += static_cast<char>(0xF0 | (code >> 18));
        tail(12), tail(6), tail(0);
    }
}

unsigned byte(const std::string& bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

std::string from_utf16(const std::string& bytes, bool big_endian) {
    const auto unit = [&](std::size_t i) {
        return big_endian ? byte(bytes, i) << 8 | byte(bytes, i + 1)
                          : byte(bytes, i + 1) << 8 | byte(bytes, i);
    };
    std::string text;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        std::uint32_t code = unit(i);
        if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size()) {
            const std::uint32_t second = unit(i + 2);
            if (second >= 0xDC00 && second < 0xE000) {
                code = 0x10000 + ((code - 0xD800) << 10) + (second - 0xDC00);
                i += 2;
            }
        }
        if (code >= 0xD800 && code < 0xE000)
            code = 0xFFFD; // half a pair
        append_utf8(text, code);
    }
    return text;
}

/// The length of the well-formed UTF-8 sequence at i and its code; 0 where there is none.
std::size_t sequence(const std::string& bytes, std::size_t i, std::uint32_t& code) {
    const unsigned lead = byte(bytes, i);
    const std::size_t length = lead < 0x80       ? 1
                               : lead >> 5 == 6  ? 2
                               : lead >> 4 == 14 ? 3
                               : lead >> 3 == 30 ? 4
                                                 : 0;
    if (length == 0 || i + length > bytes.size())
        return 0;
    code = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k) {
        if (byte(bytes, i + k) >> 6 != 2)
            return 0;
        code = code << 6 | (byte(bytes, i + k) & 0x3F);
    }
    return length;
}

bool is_utf16(std::string_view bytes) {
    return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

std::string to_utf8(std::string bytes) {
    if (is_utf16(bytes))
        return from_utf16(bytes, bytes[0] == '\xFE');
    if (std::all_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
        return bytes;
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < bytes.size();) {
        std::uint32_t code = 0;
        const std::size_t length = sequence(bytes, i, code);
        append_utf8(text, length ? code : byte(bytes, i)); // a byte outside UTF-8 is Latin-1
        i += length ? length : 1;
    }
    return text;
}

/// What a binary file says it is, in brackets.
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
                     ", expected a text file of x and height (export as text or CSV)");
}

} // namespace

std::string at(const std::string& file, int line) {
    return line > 0 ? file + ", line " + std::to_string(line) : file;
}

void expect_text(std::string_view head, const std::string& file) {
    if (!is_utf16(head) && !head.starts_with("ISO 5436") && head.find('\0') != head.npos)
        refuse_binary(head, file);
}

std::vector<std::string_view> text_lines(std::string& bytes, const std::string& file) {
    bytes = to_utf8(std::move(bytes));
    if (bytes.starts_with("ISO 5436")) // softgauges end their fields with it
        std::replace(bytes.begin(), bytes.end(), '\0', ' ');
    if (bytes.find('\0') != std::string::npos)
        refuse_binary(bytes, file);
    const std::string_view text = bytes;
    std::vector<std::string_view> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
        if (lines.size() == max_lines)
            throw InputError(file + ": more than " + std::to_string(max_lines) + " lines, expected fewer");
        lines.push_back(text.substr(start, end - start));
        const std::size_t next = std::min(text.find_first_not_of('\r', end), text.size());
        const bool carriage_returns_end_with_line_feed = next < text.size() && text[next] == '\n';
        start = carriage_returns_end_with_line_feed ? next + 1 : end + 1;
    }
    return lines;
}

} // namespace rough
