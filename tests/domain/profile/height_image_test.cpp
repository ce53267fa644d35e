#include "domain/errors.hpp"
#include "domain/profile/solid.hpp"
#include "tests/catch.hpp"

#include <cstring>
#include <map>
#include <png.h>

using namespace rough;

namespace {

/// A 16-bit greyscale file, read by libpng.
struct Picture {
    Extent size;
    std::vector<unsigned> greys; ///< row after row, the first one is the uppermost
    std::map<std::string, double> scale;
};

Picture picture_in(const std::string& bytes) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::string_view rest = bytes;
    png_set_read_fn(png, &rest, [](png_structp reader, png_bytep to, std::size_t size) {
        auto& from = *static_cast<std::string_view*>(png_get_io_ptr(reader));
        if (size > from.size()) png_error(reader, "ends early");
        std::memcpy(to, from.data(), size);
        from.remove_prefix(size);
    });
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    CHECK(png_get_bit_depth(png, info) == 16);
    CHECK(png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY);
    Picture picture{{png_get_image_width(png, info), png_get_image_height(png, info)}, {}, {}};
    for (Index j = 0; j < picture.size.rows; ++j)
        for (Index i = 0; i < picture.size.columns; ++i) {
            const png_bytep high = png_get_rows(png, info)[j] + 2 * i; // the higher byte is the first one
            picture.greys.push_back(256U * high[0] + high[1]);
        }
    png_textp text = nullptr;
    const int texts = png_get_text(png, info, &text, nullptr);
    for (int i = 0; i < texts; ++i)
        if (std::string(text[i].key) != "Description") picture.scale[text[i].key] = std::stod(text[i].text);
    png_destroy_read_struct(&png, &info, nullptr);
    return picture;
}

} // namespace

TEST_CASE("a map is read back from its picture to half a grey level") {
    for (const unsigned seed : {1U, 2U, 3U})
        for (const Extent shape : {Extent{40, 23}, {7, 64}, {1, 1}, {30, 1}}) {
            std::srand(seed);
            const Profile map{Eigen::VectorXd::Random(shape.nodes()).array() * 3e-4 - 0.7, 1e-3 / 3, shape.rows, 2e-3};
            const HeightImage image = height_image(map);
            const Picture picture = picture_in(image.png);
            CHECK(picture.size == shape);
            CHECK(picture.scale == std::map<std::string, double>(image.scale.begin(), image.scale.end()));
            CHECK(picture.scale.at("spacing_mm") == map.spacing);
            CHECK(picture.scale.at("row_spacing_mm") == map.row_spacing);
            const double level = picture.scale.at("height_per_grey_mm");
            CHECK(level == Approx((map.heights.maxCoeff() - map.heights.minCoeff()) / 65535));
            double error = 0;
            for (Index j = 0; j < shape.rows; ++j)
                for (Index i = 0; i < shape.columns; ++i)
                    error = std::max(
                        error,
                        std::abs(picture.scale.at("lowest_height_mm") +
                                 level *
                                     picture.greys[static_cast<std::size_t>((shape.rows - 1 - j) * shape.columns + i)] -
                                 map.heights[j * shape.columns + i]));
            CHECK(error <= 0.5 * level + 1e-15);
        }
}

TEST_CASE("the picture of a profile is its strip in nearly square pixels") {
    const Profile profile{Eigen::VectorXd::Random(101), 0.01};
    for (const auto& [width, rows] : {std::pair(0.0, 26), {0.5, 51}, {1e-4, 2}}) {
        const Extrusion extrusion{.width = width > 0 ? std::optional(width) : std::nullopt};
        const Picture picture = picture_in(height_image(profile, extrusion).png);
        CHECK(picture.size == Extent{101, rows});
        CHECK(picture.scale.at("row_spacing_mm") == Approx((width > 0 ? width : 0.25) / (rows - 1)));
        CHECK(std::equal(picture.greys.begin(), picture.greys.end() - 101, picture.greys.begin() + 101));
        CHECK(*std::max_element(picture.greys.begin(), picture.greys.end()) == 65535);
    }
    CHECK_THROWS_WITH(height_image(profile, {.width = 1e5}), Catch::Contains("use fewer nodes"));
}
