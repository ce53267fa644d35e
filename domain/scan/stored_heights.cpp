#include "domain/scan/stored_heights.hpp"

#include "domain/errors.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace rough {
namespace {

double stored(std::string_view bytes, std::size_t at, int type) {
    switch (type) {
    case 0:
        return little_endian<std::uint8_t>(bytes, at);
    case 1:
        return little_endian<std::uint16_t>(bytes, at);
    case 2:
        return little_endian<std::uint32_t>(bytes, at);
    case 3:
        return static_cast<double>(little_endian<float>(bytes, at));
    case 4:
        return little_endian<std::int8_t>(bytes, at);
    case 5:
        return little_endian<std::int16_t>(bytes, at);
    case 6:
        return little_endian<std::int32_t>(bytes, at);
    default:
        return little_endian<double>(bytes, at);
    }
}

} // namespace

std::vector<double> stored_heights(std::string_view bytes, std::size_t at, std::int64_t columns,
                                   std::int64_t rows, int type, double missing, const std::string& file) {
    constexpr std::array<std::int64_t, 8> sizes{1, 2, 4, 4, 1, 2, 4, 8};
    if (type < 0 || type > 7)
        refuse(file, ": numbers of type ", type, ", expected 0 to 7");
    if (columns < 1 || rows < 1 || columns > most_points / rows)
        refuse(file, ": ", rows, " rows of ", columns, " heights, expected 1 to ", most_points, " in all");
    const std::int64_t size = sizes[static_cast<std::size_t>(type)], count = rows * columns;
    const auto there = static_cast<std::int64_t>(bytes.size()) - static_cast<std::int64_t>(at);
    if (there < size * count)
        refuse(file, ": ends early, expected ", size * count, " bytes of heights, ", there < 0 ? 0 : there,
               " are there");
    std::vector<double> heights(static_cast<std::size_t>(count));
    for (double& height : heights) {
        height = stored(bytes, at, type);
        at += static_cast<std::size_t>(size);
        // The largest float marks what was not measured, too.
        if (height == missing || !(std::abs(height) < std::numeric_limits<float>::max()))
            height = std::nan("");
    }
    return heights;
}

} // namespace rough
