#include "domain/scan/map.hpp"

#include "domain/errors.hpp"
#include "domain/scan/table.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/bytes.hpp"

#include <cmath>

namespace rough {

namespace {

/// Refuses a given spacing that differs from the file's by more than a thousandth.
void agree(double of_file, double given, const char* axis, const std::string& file) {
    if (given > 0 && std::abs(given - of_file) > 1e-3 * of_file)
        refuse(file, ": the file gives a spacing along ", axis, " of ", of_file, " mm, but the given one is ",
               given, " mm; omit it");
}

void expect_size(Extent shape, const std::string& file) {
    if (shape.columns < 2 || shape.rows < 2)
        refuse(file, ": ", shape.rows, " rows of ", shape.columns,
               " heights; give a matrix of 2 x 2 or more");
}

[[noreturn]] void refuse_missing(const std::string& place, Index column, Index columns) {
    refuse(place, ": no height in column ", column + 1, "; give ", columns, " numbers in each row");
}

Map map_of(HeightMap read, const MapLayout& layout, double unit, const std::string& file) {
    const Extent shape{read.columns(), read.rows};
    expect_size(shape, file);
    if (!layout.unit.empty() && unit != read.height_unit.in_mm)
        refuse(file, ": its heights are in ", read.height_unit.name, ", but the given unit is ", layout.unit,
               "; omit it");
    agree(read.spacing, unit * layout.spacing, "x", file);
    agree(read.row_spacing, unit * layout.row_spacing, "y", file);
    for (Index k = 0; k < shape.nodes(); ++k) {
        double& height = read.heights[k];
        if (!std::isfinite(height))
            refuse_missing(line_of(file, ": row ", k / shape.columns + 1), k % shape.columns, shape.columns);
        height = height * read.height_factor * read.height_unit.in_mm;
    }
    return {{std::move(read.heights), read.spacing, shape.rows, read.row_spacing},
            read.format + ", heights in " + read.height_unit.name};
}

/// The map of columns x, y and height: a whole grid in any order.
Map map_of_points(const Table& table, double unit, const std::string& file) {
    const auto value = [&](std::size_t column, std::size_t row) { return table.at(row, column).value; };
    const auto refuse_points = [&](const auto&... why) {
        throw InputError(
            line_of(file, ": ", why..., "; give a whole grid, or the spacing of a matrix of three columns"),
            "spacing");
    };
    const auto axis = [&](std::size_t column) {
        std::vector<double> places;
        for (std::size_t k = 0; k < table.rows(); ++k)
            places.push_back(value(column, k));
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
    };
    const std::vector<double> x = axis(0), y = axis(1);
    const Extent shape{static_cast<Index>(x.size()), static_cast<Index>(y.size())};
    const auto step = [&](const std::vector<double>& places, const char* name) {
        const double mean = (places.back() - places.front()) / static_cast<double>(places.size() - 1);
        for (std::size_t k = 1; k < places.size(); ++k)
            if (!(std::abs(places[k] - places[k - 1] - mean) < 1e-3 * mean))
                refuse_points(name, " goes from ", places[k - 1], " to ", places[k],
                              ", not in even steps of ", mean);
        return unit * mean;
    };
    expect_size(shape, file);
    if (shape.columns > (2 * static_cast<Index>(table.rows()) + 2) / shape.rows) // before memory is allocated
        refuse_points(table.rows(), " points at ", shape.columns, " x and ", shape.rows, " y");
    Map map{{Eigen::VectorXd::Constant(shape.nodes(), std::nan("")), step(x, "x"), shape.rows, step(y, "y")},
            "points x, y and height"};
    const auto place = [](const std::vector<double>& places, double at) {
        return static_cast<Index>(std::lower_bound(places.begin(), places.end(), at) - places.begin());
    };
    for (std::size_t k = 0; k < table.rows(); ++k) {
        double& height = map.heights.heights[place(y, value(1, k)) * shape.columns + place(x, value(0, k))];
        if (!std::isnan(height) || !std::isfinite(value(2, k)))
            refuse(at(file, table.line[k]), ": the height is missing, or the point's second; give one");
        height = unit * value(2, k);
    }
    for (Index k = 0; k < shape.nodes(); ++k)
        if (std::isnan(map.heights.heights[k]))
            refuse_points("no height at x = ", x[static_cast<std::size_t>(k % shape.columns)],
                          ", y = ", y[static_cast<std::size_t>(k / shape.columns)]);
    return map;
}

Map map_of_matrix(const Table& table, const MapLayout& layout, double unit, const std::string& file) {
    const Extent shape{static_cast<Index>(table.columns), static_cast<Index>(table.rows())};
    expect_size(shape, file);
    if (!(layout.spacing > 0) || !(layout.row_spacing > 0))
        throw InputError(file + ": a matrix of heights; give the distance of its nodes, DX or DXxDY",
                         "spacing");
    Map map{{Eigen::VectorXd(shape.nodes()), unit * layout.spacing, shape.rows, unit * layout.row_spacing},
            "a matrix"};
    for (Index k = 0; k < shape.nodes(); ++k) {
        const double height = unit * table.cells[static_cast<std::size_t>(k)].value;
        if (!std::isfinite(height))
            refuse_missing(at(file, table.line[static_cast<std::size_t>(k / shape.columns)]),
                           k % shape.columns, shape.columns);
        map.heights.heights[k] = height;
    }
    return map;
}

Map read_any(const std::filesystem::path& path, const MapLayout& layout) {
    const double unit = layout.unit.empty() ? 1 : length_unit_named(layout.unit, "unit").in_mm;
    const std::string file = path.string();
    std::string bytes = read_whole(path);
    if (auto read = binary_map(bytes, file))
        return map_of(std::move(*read), layout, unit, file);
    const Lines lines = text_lines(bytes, file);
    if (auto read = text_map(lines, file))
        return map_of(std::move(*read), layout, unit, file);
    const Table table = read_table(lines, file, false);
    constexpr std::size_t points = 3;
    return table.columns == points && !(layout.spacing > 0) ? map_of_points(table, unit, file)
                                                            : map_of_matrix(table, layout, unit, file);
}

} // namespace

Map read_map(const std::filesystem::path& path, const MapLayout& layout) {
    Map map = read_any(path, layout);
    const Profile& of = map.heights;
    if (!std::isfinite(of.spacing * static_cast<double>(of.nodes()) * of.row_spacing))
        refuse_value("spacing", of.spacing, " mm x ", of.row_spacing,
                     " mm is too large for an area; check the unit");
    return map;
}

std::string vtk(const Profile& map) {
    const auto [columns, rows] = map.shape();
    const std::string count = std::to_string(map.nodes());
    std::string bytes = line_of("# vtk DataFile Version 3.0\nrugosa: a rough surface, mm\nBINARY\n"
                                "DATASET STRUCTURED_GRID\nDIMENSIONS ",
                                columns, " ", rows, " 1\nPOINTS ", count, " double\n");
    const auto append = [&](double value) { // the highest byte first
        std::string word;
        append_little_endian(word, value);
        bytes.append(word.rbegin(), word.rend());
    };
    for (Index k = 0; k < map.nodes(); ++k) {
        append(map.spacing * static_cast<double>(k % columns));
        append(map.row_spacing * static_cast<double>(k / columns));
        append(map.heights[k]);
    }
    bytes += "\nPOINT_DATA " + count + "\nSCALARS height_mm double 1\nLOOKUP_TABLE default\n";
    for (const double height : map.heights)
        append(height);
    return bytes + "\n";
}

} // namespace rough
