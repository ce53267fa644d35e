#include "domain/profile/height_image.hpp"

#include "domain/errors.hpp"

#include <bit>
#include <cmath>
#include <png.h>

namespace rough {
namespace {

constexpr double white = 65535, max_pixels = 25e6, max_side = 1e6; // the last is that of libpng

void append(png_structp png, png_bytep data, std::size_t size) noexcept {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// Appends a PNG file to `bytes`; false if libpng refuses. No object here has a destructor, because libpng
/// leaves by longjmp.
bool write_png(std::string& bytes, Extent size, png_bytepp rows, png_textp text, int texts) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (!info) {
        png_destroy_write_struct(&png, nullptr);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &bytes, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(size.columns), static_cast<png_uint_32>(size.rows), 16,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_text(png, info, text, texts);
    png_write_info(png, info);
    if (std::endian::native == std::endian::little)
        png_set_swap(png);
    png_write_image(png, rows);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

} // namespace

HeightImage height_image(const Profile& surface, const Extrusion& extrusion) {
    const auto [columns, map_rows] = surface.shape();
    const double width = width_of(surface, extrusion);
    const double rows = surface.is_2d() ? static_cast<double>(map_rows) // else nearly square pixels
                                        : std::max(2.0, 1 + std::round(width / surface.spacing));
    const auto side = static_cast<double>(columns);
    if (!(rows * side <= max_pixels && std::max(rows, side) <= max_side))
        refuse("height image: ", columns, " x ", rows, " pixels are more than ", max_pixels, " or than ",
               max_side, " along a side; use fewer nodes or a smaller width");
    const double lowest = surface.heights.minCoeff(), level = (surface.heights.maxCoeff() - lowest) / white;
    std::vector<std::uint16_t> greys(static_cast<std::size_t>(surface.nodes()));
    for (std::size_t i = 0; i < greys.size() && level > 0; ++i)
        greys[i] = static_cast<std::uint16_t>(
            std::lround((surface.heights[static_cast<Index>(i)] - lowest) / level));
    std::vector<png_bytep> lines(static_cast<std::size_t>(rows)); // from the largest y to the smallest
    for (std::size_t j = 0; j < lines.size(); ++j)
        lines[j] = reinterpret_cast<png_bytep>(
            &greys[surface.is_2d() ? (lines.size() - 1 - j) * static_cast<std::size_t>(columns) : 0]);

    HeightImage image;
    image.scale = {{"height_per_grey_mm", level},
                   {"lowest_height_mm", lowest},
                   {"spacing_mm", surface.spacing},
                   {"row_spacing_mm", surface.is_2d() ? surface.row_spacing : width / (rows - 1)}};
    std::vector<std::pair<std::string, std::string>> texts{
        {"Description", "height = lowest_height_mm + grey * height_per_grey_mm, x to the right, y upwards"}};
    for (const auto& [name, value] : image.scale) {
        PlainStream digits;
        digits.precision(17);
        digits << value;
        texts.emplace_back(name, digits.str());
    }
    std::vector<png_text> chunks(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
        chunks[i].key = texts[i].first.data();
        chunks[i].text = texts[i].second.data();
        chunks[i].text_length = texts[i].second.size();
    }
    if (!write_png(image.png, {columns, static_cast<Index>(rows)}, lines.data(), chunks.data(),
                   static_cast<int>(chunks.size())))
        refuse("height image: libpng cannot write it; use fewer nodes");
    return image;
}

} // namespace rough
