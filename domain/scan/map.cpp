#include "domain/scan/map.hpp"

#include "domain/errors.hpp"
#include "domain/scan/table.hpp"
#include "domain/scan/unit.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/lines.hpp"

#include <cmath>

namespace rough {

Profile read_map(const std::filesystem::path& path, const MapLayout& layout) {
    const double unit = layout.unit.empty() ? 1 : length_unit_named(layout.unit, "unit").in_mm;
    const std::string file = path.string();
    const Table table = read_table(text_lines(read_whole(path), file), file, false);
    const Extent shape{static_cast<Index>(table.columns), static_cast<Index>(table.rows())};
    if (shape.columns < 2 || shape.rows < 2)
        throw InputError(file + ": " + std::to_string(shape.rows) + " rows of " +
                         std::to_string(shape.columns) + " heights, expected a matrix of 2 x 2 or more");
    Profile map{Eigen::VectorXd(shape.nodes()), unit * layout.spacing, shape.rows, unit * layout.row_spacing};
    for (Index j = 0; j < shape.rows; ++j)
        for (Index i = 0; i < shape.columns; ++i) {
            const double height =
                unit * table.column[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].value;
            if (!std::isfinite(height))
                throw InputError(at(file, table.line[static_cast<std::size_t>(j)]) +
                                 ": no height in column " + std::to_string(i + 1) + ", expected " +
                                 std::to_string(shape.columns) + " numbers a row");
            map.heights[j * shape.columns + i] = height;
        }
    return map;
}

} // namespace rough
