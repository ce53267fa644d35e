#include "apps/report/height_picture.hpp"

#include "apps/report/html.hpp"

#include <boost/crc.hpp>

#include <array>

namespace app {

namespace {

constexpr rough::Index most_pixels = 512; ///< along a side

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(number >> shift & 0xFF);
    return bytes;
}

std::string chunk(const std::string& name, const std::string& content) {
    boost::crc_32_type crc;
    const std::string checked = name + content;
    crc.process_bytes(checked.data(), checked.size());
    return big_endian(static_cast<std::uint32_t>(content.size())) + checked + big_endian(crc.checksum());
}

/// A zlib stream that stores its content as it is.
std::string stored(const std::string& content) {
    constexpr std::size_t most = 65535;
    std::string stream = "\x78\x01";
    for (std::size_t at = 0; at < content.size(); at += most) {
        const std::size_t length = std::min(most, content.size() - at);
        stream += at + length == content.size() ? '\1' : '\0';
        for (const std::size_t number : {length, ~length})
            for (const int shift : {0, 8})
                stream += static_cast<char>(number >> shift & 0xFF);
        stream += content.substr(at, length);
    }
    std::uint32_t a = 1, b = 0; // Adler-32
    for (const char byte : content) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return stream + big_endian(b << 16 | a);
}

/// 256 colours of even steps in lightness, between six of Matplotlib's viridis.
std::string palette() {
    constexpr std::array<std::array<double, 3>, 6> marks{
        {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
    std::string colours;
    for (int k = 0; k < 256; ++k) {
        const double at = 5.0 * k / 255;
        const auto left = static_cast<std::size_t>(std::min(at, 4.0));
        for (std::size_t c = 0; c < 3; ++c)
            colours += static_cast<char>(std::lround(
                marks[left][c] + (at - static_cast<double>(left)) * (marks[left + 1][c] - marks[left][c])));
    }
    return colours;
}

} // namespace

std::string height_png(const rough::Profile& map) {
    const auto [columns, rows] = map.shape();
    const rough::Index across = (columns - 1) / most_pixels + 1, up = (rows - 1) / most_pixels + 1;
    const Eigen::Map<const Eigen::ArrayXXd> z(map.heights.data(), columns, rows);
    const double lowest = z.minCoeff(), range = std::max(z.maxCoeff() - lowest, 1e-300);
    std::string lines;
    for (rough::Index j = (rows - 1) / up; j >= 0; --j) {
        lines += '\0'; // without a filter
        for (rough::Index i = 0; i * across < columns; ++i) {
            const double mean = z.block(i * across, j * up, std::min(across, columns - i * across),
                                        std::min(up, rows - j * up))
                                    .mean();
            lines += static_cast<char>(std::lround(255 * (mean - lowest) / range));
        }
    }
    const std::string head = big_endian(static_cast<std::uint32_t>((columns - 1) / across + 1)) +
                             big_endian(static_cast<std::uint32_t>((rows - 1) / up + 1)) +
                             std::string("\x08\x03\0\0\0", 5); // a byte a pixel, of a palette
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", head) + chunk("PLTE", palette()) +
           chunk("IDAT", stored(lines)) + chunk("IEND", "");
}

std::string embedded(const std::string& png, const std::string& alt) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t at = 0; at < png.size(); at += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = at; k < at + 3; ++k)
            three = three << 8 | (k < png.size() ? static_cast<unsigned char>(png[k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += at + k > png.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return "<img style=\"width:100%;max-width:32rem\" alt=\"" + escaped(alt) +
           "\" src=\"data:image/png;base64," + text + "\">";
}

} // namespace app
