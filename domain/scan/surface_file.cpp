#include "domain/scan/surface_file.hpp"

#include "domain/errors.hpp"
#include "domain/scan/header.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/zip.hpp"

#include <cmath>

namespace rough {
namespace {

constexpr std::size_t no_column = static_cast<std::size_t>(-1);
constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view archive_start = "PK\x03\x04";

/// The units of a surface's axes.
struct Units {
    LengthUnit x, y, height;
};

/// The given unit or units; nothing if none is given.
std::optional<Units> given_units(const ScanOptions& options) {
    if (options.unit.empty()) return std::nullopt;
    const std::size_t comma = options.unit.find(',');
    const LengthUnit x = length_unit_named(options.unit.substr(0, comma), "unit");
    return Units{x, x, comma == std::string::npos ? x : length_unit_named(options.unit.substr(comma + 1), "unit")};
}

void agree(const LengthUnit& named, const LengthUnit& given, const char* what, const std::string& file) {
    if (named.in_mm != given.in_mm)
        refuse(file, ": its header gives ", what, " in ", named.name, ", but the given unit is ", given.name,
               "; omit the unit");
}

/// Refuses a given spacing that differs from the file's by more than a thousandth and its rounding.
void agree(double of_file, double given, const char* axis, double rounding, const std::string& file) {
    if (given > 0 && std::abs(given - of_file) > std::max(1e-3, 1.5 * rounding) * of_file)
        refuse(file, ": the file gives a spacing along ", axis, " of ", of_file, " mm, but the given one is ", given,
               " mm; omit it");
}

/// The given spacings along x and y in mm; 0: none.
std::pair<double, double> given_spacings(const ScanOptions& options) {
    const auto units = given_units(options);
    const double unit = units ? units->x.in_mm : 1;
    return {options.spacing * unit, (options.row_spacing > 0 ? options.row_spacing : options.spacing) * unit};
}

/// The columns of a list of points; no_column if the heights stand alone.
struct Layout {
    std::size_t x = no_column, y = no_column, height = 0, validity = no_column;
};

bool counts(const Table& table, std::size_t column) {
    for (std::size_t i = 0; i < table.rows(); ++i)
        if (table.at(i, column).value != table.at(0, column).value + static_cast<double>(i) ||
            table.at(i, column).last_place != 0)
            return false;
    return table.rows() > 1;
}

Layout profile_layout(const Table& table, const Header& header, bool spacing_given, const std::string& file) {
    const auto only_0_and_1 = [&](std::size_t column) {
        for (std::size_t i = 0; i < table.rows(); ++i)
            if (table.at(i, column).value != 0 && table.at(i, column).value != 1) return false;
        return true;
    };
    if (table.columns == 1) return {};
    if (table.columns == 2 && !spacing_given) return {.x = 0, .height = 1};
    if (table.columns == 2 && counts(table, 0)) return {.height = 1};
    if (table.columns == 2)
        refuse(file, ": two columns, x and height; omit the spacing, or give one column of heights");
    if (table.columns == 3 && header.validity_column && only_0_and_1(2)) return {.x = 0, .height = 1, .validity = 2};
    if (table.columns == 3 && counts(table, 0)) return {.x = 1, .height = 2};
    const bool commas = table.dialect.separator == Dialect::Separator::comma;
    throw InputError(
        line_of(at(file, table.line[0]), ": ", table.columns,
                " columns; give heights, or x and height, or the row to take of a map, or the map as a surface",
                commas ? " (decimal commas need another separator)" : ""),
        "row");
}

/// The rounding of a column. Numbers may be written without zeros at their end, so the finest one counts.
Rounding rounding_of(const Table& table, std::size_t column) {
    int last = std::numeric_limits<int>::max();
    double digits = 1; // significant ones
    for (std::size_t k = 0; k < table.rows(); ++k)
        if (const auto& [value, place] = table.at(k, column); !std::isnan(value)) {
            last = std::min(last, place);
            if (value != 0) digits = std::max(digits, std::floor(std::log10(std::abs(value))) - place + 1);
        }
    return {std::pow(10., last), std::pow(10., 1 - digits)};
}

/// The different numbers of a column, increasing.
struct Places {
    std::vector<double> all;
    Rounding rounding;
};
Places places_in(const Table& table, std::size_t column) {
    Places found{{}, rounding_of(table, column)};
    for (std::size_t k = 0; k < table.rows(); ++k)
        if (!std::isnan(table.at(k, column).value)) found.all.push_back(table.at(k, column).value);
    std::sort(found.all.begin(), found.all.end());
    found.all.erase(std::unique(found.all.begin(), found.all.end()), found.all.end());
    return found;
}

/// Whether three columns are x, y and height: by their names, or because the first two make most of a grid.
bool is_list(const Header& header, const Places& x, const Places& y, std::size_t points) {
    if (header.names[0].starts_with('x') && header.names[1].starts_with('y')) return true;
    const auto nodes = static_cast<double>(x.all.size()) * static_cast<double>(y.all.size()),
               rows = static_cast<double>(points);
    constexpr double least = 0.7;
    return x.all.size() > 1 && y.all.size() > 1 && rows <= nodes && rows >= least * nodes &&
           evenness(x.all, x.rounding).even && evenness(y.all, y.rounding).even;
}

/// The unit of each axis: from the header, else the given one, else mm. Says which in `account`.
Units units_of(const Header& header, const Layout& layout, const ScanOptions& options, const std::string& file,
               std::string& account) {
    const std::optional<Units> given = given_units(options);
    const bool has_x = layout.x != no_column, has_y = layout.y != no_column;
    const auto named = [&](std::size_t column, const std::optional<LengthUnit>& by_key) {
        const bool has_name = column < header.units.size();
        const auto unit = has_name && header.units[column] ? header.units[column] : by_key;
        if (!given && !unit && has_name && !header.unknown_units[column].empty())
            throw InputError(file + ": a column in '" + header.unknown_units[column] +
                                 "', which is not a known length unit; correct it, or give one",
                             "unit");
        return unit;
    };
    // In the header of a profile, y may be the height.
    const auto height_key = header.height_unit || has_y ? header.height_unit : header.y_unit;
    struct Axis {
        const char* name;
        bool exists;
        std::optional<LengthUnit> of_header;
        LengthUnit Units::*unit;
    };
    const Axis axes[] = {{"x", has_x, named(layout.x, header.x_unit), &Units::x},
                         {"y", has_y, named(layout.y, header.y_unit ? header.y_unit : header.x_unit), &Units::y},
                         {"heights", true, named(layout.height, height_key), &Units::height}};
    const bool all_in_header =
        std::ranges::all_of(axes, [](const Axis& axis) { return !axis.exists || axis.of_header; });
    const LengthUnit mm{"mm", 1};
    Units units = given.value_or(Units{mm, mm, mm});
    for (const auto& [name, exists, of_header, unit] : axes) {
        if (!exists) continue;
        if (given && all_in_header) agree(*of_header, units.*unit, name, file);
        units.*unit = of_header.value_or(units.*unit);
        account += (account.empty() ? "" : ", ") + std::string(name) + " in " + (units.*unit).name +
                   (of_header ? " (header)"
                    : given   ? " (given)"
                              : " (assumed)");
    }
    return units;
}

/// Takes the spacings of heights without places from the header or the caller, and says which.
void take_spacings(HeightMap& map, const Header& header, const ScanOptions& options, const std::string& file) {
    const auto units = given_units(options);
    const auto [along, across] = given_spacings(options);
    bool assumed = false;
    const auto spacing = [&](const std::optional<HeaderLength>& step, const std::optional<HeaderLength>& side,
                             const std::optional<LengthUnit>& unit, Index points, double given, const char* axis) {
        const auto& length = step ? step : side;
        if (!length) return given;
        assumed |= !length->unit && !unit && !units;
        const LengthUnit of = length->unit ? *length->unit : unit ? *unit : units ? units->x : LengthUnit{"mm", 1};
        const double read = length->value * of.in_mm / (step ? 1 : static_cast<double>(points));
        agree(read, given, axis, length->rounding, file);
        return read;
    };
    map.spacing = spacing(header.spacing, header.width, header.x_unit, map.columns(), along, "x");
    if (!(map.spacing > 0))
        throw InputError(file + (map.rows > 1 && options.row == 0
                                     ? ": a matrix of heights; give the distance of its nodes, DX or DXxDY"
                                     : ": one column of heights without a spacing; give the spacing"),
                         "spacing");
    const bool has_rows = header.row_spacing || (header.height && !header.spacing);
    const auto& y_unit = header.y_unit ? header.y_unit : header.x_unit;
    if (map.rows > 1)
        map.row_spacing = has_rows     ? spacing(header.row_spacing, header.height, y_unit, map.rows, across, "y")
                          : across > 0 ? across
                                       : map.spacing;
    if (header.spacing || header.width)
        map.units += line_with_digits(6, ", spacing ", map.spacing,
                                      map.rows > 1 ? line_with_digits(6, " x ", map.row_spacing) : "",
                                      assumed ? " mm (header, mm assumed)" : " mm (header)");
    else
        map.units += units ? ", spacing in " + units->x.name + " (given)" : ", spacing in mm (assumed)";
}

/// The map of columns x, y and height: the points of a grid in any order, of which some may be missing.
void take_list(HeightMap& map, const Table& table, const Places& x, const Places& y, const Units& units,
               const ScanOptions& options, const std::string& file) {
    const auto refuse_points = [&](const auto&... why) {
        throw InputError(
            line_of(file, ": ", why..., "; give a whole grid, or the spacing of a matrix of three columns"), "spacing");
    };
    const auto columns = static_cast<Index>(x.all.size()), rows = static_cast<Index>(y.all.size());
    if (columns * rows == 0 || columns > (4 * static_cast<Index>(table.rows()) + 2) / rows) // before memory
        refuse_points(table.rows(), " points at ", columns, " x and ", rows, " y");
    const auto step = [&](const Places& places, const char* name) {
        if (places.all.size() < 2) return 0.;
        const Evenness fit = evenness(places.all, places.rounding);
        for (std::size_t k = 1; k < places.all.size() && !fit.even; ++k)
            if (!(std::abs(places.all[k] - places.all[k - 1] - fit.spacing) < 1e-3 * fit.spacing))
                refuse_points(name, " goes from ", places.all[k - 1], " to ", places.all[k], ", not in even steps of ",
                              fit.spacing);
        return fit.spacing;
    };
    const double dx = step(x, "x"), dy = step(y, "y");
    map.format = "points x, y and height";
    map.rows = rows;
    map.spacing = units.x.in_mm * dx, map.row_spacing = units.y.in_mm * dy;
    const auto [along, across] = given_spacings(options);
    agree(map.spacing, along, "x", 0, file), agree(map.row_spacing, across, "y", 0, file);
    map.heights = Eigen::VectorXd::Constant(columns * rows, missing);
    std::vector<char> seen(static_cast<std::size_t>(columns * rows), 0);
    const auto place = [](const std::vector<double>& places, double at) {
        return static_cast<Index>(std::lower_bound(places.begin(), places.end(), at) - places.begin());
    };
    for (std::size_t k = 0; k < table.rows(); ++k) {
        const double at_x = table.at(k, 0).value, at_y = table.at(k, 1).value;
        if (std::isnan(at_x) || std::isnan(at_y))
            refuse(at(file, table.line[k]), ": a point without x or y; give both, or remove it");
        const Index node = place(y.all, at_y) * columns + place(x.all, at_x);
        if (std::exchange(seen[static_cast<std::size_t>(node)], 1))
            refuse(at(file, table.line[k]), ": the second height at x = ", at_x, ", y = ", at_y, "; give one");
        map.heights[node] = table.at(k, 2).value;
    }
}

/// The surface in a table of text.
HeightMap table_map(const Lines& lines, const ScanOptions& options, bool as_map, const std::string& file) {
    bool one_column = !as_map && options.spacing > 0;
    for (std::size_t i = 0; i < lines.size() && !one_column && !as_map; ++i) one_column = names_spacing(lines[i]);
    const Table table = read_table(lines, file, one_column);
    const Header header = read_header(table, file);
    const bool grid = as_map || options.row > 0 || (table.columns > 3 && table.rows() == 1),
               has_spacing = options.spacing > 0 || header.spacing || header.width;
    const auto cells = static_cast<Index>(table.cells.size());
    HeightMap map{"a matrix"};
    map.height_factor = header.height_factor;
    if (grid && table.columns == 3) {
        const Places x = places_in(table, 0), y = places_in(table, 1);
        if ((as_map && !has_spacing) || is_list(header, x, y, table.rows())) {
            const Units units = units_of(header, {.x = 0, .y = 1, .height = 2}, options, file, map.units);
            map.height_unit = units.height;
            take_list(map, table, x, y, units, options, file);
            return map;
        }
    }
    if (grid) {
        const bool in_one_column =
            table.columns == 1 && header.columns > 0 && header.rows > 1 && header.columns * header.rows == cells;
        map.rows = in_one_column ? header.rows : static_cast<Index>(table.rows());
        map.heights.resize(cells);
        for (Index k = 0; k < cells; ++k) map.heights[k] = table.cells[static_cast<std::size_t>(k)].value;
        if (options.row > 0 && (map.columns() < 3 || options.row > map.rows))
            throw InputError(line_of(file, ": row ", options.row, " of ", map.rows, " rows of ", map.columns(),
                                     " heights is not a row of an areal matrix; give another row or file"),
                             "row");
        if (header.columns > 0 && header.rows > 0 && header.columns * header.rows != cells)
            refuse(file, ": ", map.rows, " rows of ", map.columns(), " heights, but its header gives ", header.rows,
                   " rows of ", header.columns, "; export it again");
        map.height_unit = units_of(header, {}, options, file, map.units).height;
        for (Index k = 0; k < cells; ++k) map.line.push_back(table.line[static_cast<std::size_t>(k) / table.columns]);
        take_spacings(map, header, options, file);
        return map;
    }
    const Layout layout = profile_layout(table, header, options.spacing > 0, file);
    const Units units = units_of(header, layout, options, file, map.units);
    map.format.clear();
    map.height_unit = units.height;
    map.heights.resize(static_cast<Index>(table.rows()));
    const bool has_x = layout.x != no_column;
    if (has_x) map.rounding = rounding_of(table, layout.x);
    map.rounding.digit *= units.x.in_mm;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const bool valid = layout.validity == no_column || table.at(i, layout.validity).value == 1;
        map.heights[static_cast<Index>(i)] = valid ? table.at(i, layout.height).value : missing;
        if (has_x) map.x.push_back(table.at(i, layout.x).value * units.x.in_mm);
    }
    if (!has_x) take_spacings(map, header, options, file);
    if (table.lone > 1 || (table.lone == 1 && table.announced < 0))
        map.units += "; the first " + (table.lone > 1 ? std::to_string(table.lone) + " lines are" : "line is") +
                     std::string(" read as the number of points and a length, not as heights");
    else if (table.announced == static_cast<long>(table.rows()) && table.columns == 1)
        map.units += "; the first line is read as the number of points";
    map.announced = table.announced;
    map.line = table.line;
    return map;
}

} // namespace

Evenness evenness(const std::vector<double>& x, const Rounding& rounding) {
    // A fit would find a spacing whose multiples these are only up to rounding.
    std::size_t multiples = 0;
    while (multiples < x.size() && x[multiples] == static_cast<double>(multiples) * x[1]) ++multiples;
    if (multiples == x.size() && x[1] > 0) return {0, x[1], 0, true};
    const double n = static_cast<double>(x.size());
    const double middle = (n - 1) / 2;
    double mean = 0, slope = 0;
    for (const double value : x) mean += value / n;
    for (std::size_t i = 0; i < x.size(); ++i) slope += (static_cast<double>(i) - middle) * (x[i] - mean);
    slope /= n * (n * n - 1) / 12;

    Evenness fit{mean - slope * middle, slope, 0, slope > 0};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double error = std::abs(x[i] - (fit.first + slope * static_cast<double>(i)));
        fit.deviation = std::max(fit.deviation, error);
        // Rounding moves a point by half its last digit, and the fit by less than half of that.
        const double digit = std::max(rounding.digit, std::abs(x[i]) * rounding.share);
        fit.even = fit.even && error <= std::max(std::min(0.75 * digit, slope / 8), 1e-3 * slope);
    }
    return fit;
}

HeightMap read_heights(const std::filesystem::path& path, const ScanOptions& options, bool as_map) {
    const std::string file = path.string();
    std::string bytes = read_whole(path, max_file_bytes, [&](std::string_view head) {
        if (!is_binary_map(head) && !head.starts_with(archive_start)) expect_text(head, file);
    });
    std::optional<HeightMap> read = binary_map(bytes, file);
    if (bytes.starts_with(archive_start)) {
        const Zip archive(bytes, file);
        if (auto sheet = sheet_of(archive, file)) {
            read = table_map(text_lines(*sheet, file), options, as_map, file);
            read->format = "Excel workbook" + (read->format.empty() ? "" : ", " + read->format);
        } else {
            read = read_x3p(archive, file);
        }
    }
    if (!read) {
        const Lines lines = text_lines(bytes, file);
        read = text_map(lines, file);
        if (!read) read = table_map(lines, options, as_map, file);
    }
    if (read->units.empty()) { // a format that states them
        if (const auto units = given_units(options)) agree(read->height_unit, units->height, "heights", file);
        const auto [along, across] = given_spacings(options);
        agree(read->spacing, along, "x", 0, file);
        if (read->rows > 1 && as_map) agree(read->row_spacing, across, "y", 0, file);
        read->units = "heights in " + read->height_unit.name;
    }
    read->heights *= read->height_factor * read->height_unit.in_mm;
    read->height_factor = 1;
    return std::move(*read);
}

} // namespace rough
