#include "domain/scan/scan.hpp"

#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/scan/table.hpp"
#include "domain/text/atomic_file.hpp"

#include <numeric>

namespace rough {

namespace {

constexpr std::size_t no_column = static_cast<std::size_t>(-1);
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// A scan's points as the file gives them; NaN if a value is missing.
struct Points {
    double spacing = 0;    ///< mm; if above 0, point i is at i times this, and x and last_digit are empty
    std::vector<double> x; ///< mm
    std::vector<double> last_digit; ///< one unit in x's last written digit, mm
    std::vector<double> heights;    ///< mm
    std::vector<int> line;          ///< in the file; empty for a binary one

    std::size_t size() const { return heights.size(); } ///< missing points included
    double at(std::size_t i) const { return spacing > 0 ? static_cast<double>(i) * spacing : x[i]; } ///< mm
    int line_of(std::size_t i) const { return line.empty() ? 0 : line[i]; } ///< 0: none
    bool is_whole(std::size_t i) const { return !std::isnan(at(i)) && !std::isnan(heights[i]); }
    void each_list(auto change) { change(x), change(last_digit), change(heights), change(line); }
};

void refuse_missing(const Points& points, const std::string& file) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points.is_whole(i))
            throw InputError(line_of(at(file, points.line_of(i)), ": a missing value; give ",
                                     std::isnan(points.at(i)) ? "an x" : "a height",
                                     ", or fill it by interpolation"),
                             "fill");
}

/// Fills missing heights between two others. Removes points without x, and points without height at either
/// end. Returns the number of filled heights.
std::size_t fill(Points& points) {
    std::size_t first = 0, end = points.size(), kept = 0, filled = 0;
    while (first < end && !points.is_whole(first))
        ++first;
    while (end > first && !points.is_whole(end - 1))
        --end;
    for (std::size_t i = first; i < end; ++i) {
        points.each_list([&](auto& list) {
            if (!list.empty())
                list[kept] = list[i];
        });
        kept += !std::isnan(points.at(kept));
    }
    points.each_list([&](auto& list) { list.resize(std::min(list.size(), kept)); });
    for (std::size_t left = 0, right = 1; right < points.size(); left = right++) {
        while (std::isnan(points.heights[right]))
            ++right;
        const double run = points.at(right) - points.at(left);
        for (std::size_t i = left + 1; i < right; ++i, ++filled) {
            const double share = run != 0 ? (points.at(i) - points.at(left)) / run : 0.5;
            points.heights[i] = points.heights[left] + share * (points.heights[right] - points.heights[left]);
        }
    }
    return filled;
}

/// The even spacing nearest to the points, and their distance from it.
struct Evenness {
    double first = 0;     ///< x of the first even node, mm
    double spacing = 0;   ///< least-squares spacing, mm, > 0
    double deviation = 0; ///< largest distance of a point from its even node, mm
    bool even = false;    ///< each point is within 1e-3 spacings, or its last written digit, of its node
};

/// Fits even nodes to x (increasing, two points or more) by least squares over the index. `last_digit` is one
/// unit in each point's last written digit, 0 if unknown.
Evenness evenness(const std::vector<double>& x, const std::vector<double>& last_digit) {
    // A fit would find a spacing whose multiples these are only up to rounding.
    std::size_t multiples = 0;
    while (multiples < x.size() && x[multiples] == static_cast<double>(multiples) * x[1])
        ++multiples;
    if (multiples == x.size() && x[1] > 0)
        return {0, x[1], 0, true};
    const double n = static_cast<double>(x.size());
    const double middle = (n - 1) / 2;
    double mean = 0, slope = 0;
    for (const double value : x)
        mean += value / n;
    for (std::size_t i = 0; i < x.size(); ++i)
        slope += (static_cast<double>(i) - middle) * (x[i] - mean);
    slope /= n * (n * n - 1) / 12;

    Evenness fit{mean - slope * middle, slope, 0, slope > 0};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double error = std::abs(x[i] - (fit.first + slope * static_cast<double>(i)));
        fit.deviation = std::max(fit.deviation, error);
        // Rounding moves a point by half its last digit, and the fit by less than half of that.
        fit.even = fit.even && error <= std::max(0.75 * last_digit[i], 1e-3 * slope);
    }
    return fit;
}

/// Heights at `nodes` even nodes from the first to the last x, linear between the points; x strictly
/// increasing.
Profile resampled(const std::vector<double>& x, const std::vector<double>& heights, Index nodes) {
    Profile profile{Eigen::VectorXd(nodes), (x.back() - x.front()) / static_cast<double>(nodes - 1)};
    std::size_t right = 1;
    for (Index i = 0; i < nodes; ++i) {
        const double at = std::min(x.front() + static_cast<double>(i) * profile.spacing, x.back());
        while (right + 1 < x.size() && x[right] < at)
            ++right;
        const double share = (at - x[right - 1]) / (x[right] - x[right - 1]);
        profile.heights[i] = heights[right - 1] + share * (heights[right] - heights[right - 1]);
    }
    return profile;
}

/// One line on what was read and done; numbers to six digits.
struct ScanAccount {
    PlainStream text;
    template <class... Parts>
    void say(const Parts&... parts) {
        if (text.tellp() > 0)
            text << "; ";
        (text << ... << parts);
    }
};

/// "1 point", "2 points".
std::string counted(std::size_t count, const std::string& of) {
    return std::to_string(count) + " " + of + (count == 1 ? "" : "s");
}

/// Whether the first column counts the rows.
bool has_running_index(const Table& table) {
    for (std::size_t i = 0; i < table.rows(); ++i)
        if (table.at(i, 0).value != table.at(0, 0).value + static_cast<double>(i) ||
            table.at(i, 0).last_place != 0)
            return false;
    return table.rows() > 1;
}

/// The columns of x, heights and validity.
struct Layout {
    std::size_t x = no_column, height = 0, validity = no_column;
};

Layout layout_of(const Table& table, const Header& header, bool spacing_given, const std::string& file) {
    const auto only_0_and_1 = [&](std::size_t column) {
        for (std::size_t i = 0; i < table.rows(); ++i)
            if (table.at(i, column).value != 0 && table.at(i, column).value != 1)
                return false;
        return true;
    };
    if (table.columns == 1)
        return {};
    if (table.columns == 2 && !spacing_given)
        return {0, 1};
    if (table.columns == 2 && has_running_index(table))
        return {no_column, 1};
    if (table.columns == 2)
        refuse(file, ": two columns, x and height; omit the spacing, or give one column of heights");
    if (table.columns == 3 && header.validity_column && only_0_and_1(2))
        return {0, 1, 2};
    if (table.columns == 3 && has_running_index(table))
        return {1, 2};
    const bool commas = table.dialect.separator == Dialect::Separator::comma;
    throw InputError(
        line_of(at(file, table.line[0]), ": ", table.columns,
                " columns; give heights, or x and height, or for an areal matrix the row to take",
                commas ? " (decimal commas need another separator)" : ""),
        "row");
}

/// Makes one column of a row of many heights: the only row, or the requested one (from 1).
void take_row(Table& table, Index requested, const std::string& file, ScanAccount& account) {
    if (requested == 0 && !(table.columns > 3 && table.rows() == 1))
        return;
    const auto row = static_cast<std::size_t>(std::max<Index>(requested, 1)) - 1;
    if (requested > 0) {
        const std::string size = line_of(table.rows(), " rows of ", table.columns, " heights");
        if (table.columns < 3 || row >= table.rows())
            throw InputError(line_of(file, ": row ", requested, " of ", size,
                                     " is not a row of an areal matrix; give another row or file"),
                             "row");
        account.say("row ", requested, " of ", size);
    }
    const auto first = table.cells.begin() + static_cast<std::ptrdiff_t>(row * table.columns);
    table.cells = {first, first + static_cast<std::ptrdiff_t>(table.columns)};
    table.line.assign(table.columns, table.line[row]);
    table.columns = 1;
}

struct Units {
    LengthUnit x, height;
};

/// The given unit or units; nothing if none is given.
std::optional<Units> given_units(const ScanOptions& options) {
    if (options.unit.empty())
        return std::nullopt;
    const std::size_t comma = options.unit.find(',');
    const LengthUnit x = length_unit_named(options.unit.substr(0, comma), "unit");
    return Units{x,
                 comma == std::string::npos ? x : length_unit_named(options.unit.substr(comma + 1), "unit")};
}

void agree(const LengthUnit& named, const LengthUnit& given, const char* what, const std::string& file) {
    if (named.in_mm != given.in_mm)
        refuse(file, ": its header gives ", what, " in ", named.name, ", but the given unit is ", given.name,
               "; omit the unit");
}

/// The unit of each column: from its header, else the given one, else mm.
Units units_of(const Header& header, const Layout& layout, const ScanOptions& options,
               const std::string& file, ScanAccount& account) {
    const std::optional<Units> given = given_units(options);
    const bool has_x = layout.x != no_column;
    const auto named = [&](std::size_t column, const std::optional<LengthUnit>& by_key) {
        const bool has_name = column < header.units.size();
        const auto unit = has_name && header.units[column] ? header.units[column] : by_key;
        if (!given && !unit && has_name && !header.unknown_units[column].empty())
            throw InputError(file + ": a column in '" + header.unknown_units[column] +
                                 "', which is not a known length unit; correct it, or give one",
                             "unit");
        return unit;
    };
    const auto x = named(layout.x, header.x_unit), height = named(layout.height, header.height_unit);
    if (given && height && (!has_x || x)) {
        if (has_x)
            agree(*x, given->x, "x", file);
        agree(*height, given->height, "heights", file);
    }
    const Units rest = given.value_or(Units{{"mm", 1}, {"mm", 1}});
    const std::string source = given ? " (given)" : " (assumed)";
    const Units units{x.value_or(rest.x), height.value_or(rest.height)};
    account.say(has_x ? "x in " + units.x.name + (x ? "" : source) + ", " : "", "heights in ",
                units.height.name, height ? "" : source);
    return units;
}

/// The given spacing in mm; 0: none.
double spacing_given(const ScanOptions& options) {
    const auto units = given_units(options);
    return options.spacing * (units ? units->x.in_mm : 1);
}

void agree(double from_header, double given, const std::string& file) {
    if (given > 0 && from_header > 0 && std::abs(given - from_header) > 1e-3 * from_header)
        refuse(file, ": its header gives a spacing of ", from_header, " mm, but the given spacing is ", given,
               " mm; omit it");
}

/// The spacing of a one-column file in mm, from the caller or the header.
double spacing_of(const Header& header, const ScanOptions& options, std::size_t rows, const LengthUnit& rest,
                  const std::string& file) {
    double from_header = 0;
    if (const auto& length = header.spacing ? header.spacing : header.width)
        from_header = length->value * length->unit.value_or(rest).in_mm /
                      (header.spacing ? 1 : static_cast<double>(rows));
    const double given = spacing_given(options);
    agree(from_header, given, file);
    if (!(given > 0) && !(from_header > 0))
        throw InputError(file + ": one column of heights without a spacing; give the spacing", "spacing");
    return from_header > 0 ? from_header : given;
}

/// The points of a map: its only row, or the requested one.
Points points_of(const HeightMap& map, const ScanOptions& options, const std::string& file,
                 ScanAccount& account) {
    if (const auto units = given_units(options))
        agree(map.height_unit, units->height, "heights", file);
    agree(map.spacing, spacing_given(options), file);
    const std::string size = line_of(map.rows, " rows of ", map.columns(), " heights");
    if (map.rows == 1 && options.row > 0)
        throw InputError(file + ": " + map.format + " contains one profile; omit the row", "row");
    if (map.rows > 1 && (options.row < 1 || options.row > map.rows))
        throw InputError(line_of(file, ": an areal map of ", size, "; give the row to take, 1 to ", map.rows),
                         "row");
    account.say(map.format, ", heights in ", map.height_unit.name,
                map.rows > 1 ? line_of("; row ", options.row, " of ", size) : "");
    const Index first = map.columns() * std::max<Index>(options.row - 1, 0);
    Points points;
    points.spacing = map.spacing;
    for (Index i = first; i < first + map.columns(); ++i)
        points.heights.push_back(map.heights[i] * map.height_factor * map.height_unit.in_mm);
    if (!map.line.empty())
        points.line.assign(map.line.begin() + first, map.line.begin() + first + map.columns());
    if (map.announced >= 0 && map.announced != map.columns())
        account.say("the file announces ", map.announced, " points");
    return points;
}

Points points_of(const Lines& lines, const ScanOptions& options, const std::string& file,
                 ScanAccount& account) {
    bool one_column = options.spacing > 0;
    for (std::size_t i = 0; i < lines.size() && !one_column; ++i)
        one_column = names_spacing(lines[i]);
    Table table = read_table(lines, file, one_column);
    const Header header = read_header(table, file);
    take_row(table, options.row, file, account);
    const Layout layout = layout_of(table, header, options.spacing > 0, file);
    const Units units = units_of(header, layout, options, file, account);
    const bool has_x = layout.x != no_column;
    Points points;
    if (!has_x)
        points.spacing =
            spacing_of(header, options, table.rows(), header.x_unit.value_or(units.height), file);
    for (auto* list : {&points.heights, &points.x, &points.last_digit})
        list->reserve(has_x || list == &points.heights ? table.rows() : 0);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double height = table.at(i, layout.height).value;
        const bool valid = layout.validity == no_column || table.at(i, layout.validity).value == 1;
        points.heights.push_back(valid ? height * header.height_factor * units.height.in_mm : missing);
        if (has_x) {
            points.x.push_back(table.at(i, layout.x).value * units.x.in_mm);
            points.last_digit.push_back(std::pow(10., table.at(i, layout.x).last_place) * units.x.in_mm);
        }
    }
    if (table.announced >= 0 && table.announced != static_cast<long>(points.size()))
        account.say("the file announces ", table.announced, " points");
    else if (table.announced >= 0 && table.columns == 1)
        account.say("the first line is read as the number of points");
    points.line = std::move(table.line);
    return points;
}

/// The points without gaps, x growing from the first to the last.
Points in_order(Points points, bool fills, const std::string& file, ScanAccount& account) {
    if (!fills)
        refuse_missing(points, file);
    const std::size_t all = points.size();
    if (const std::size_t filled = fill(points))
        account.say(counted(filled, "missing height"), " filled linearly");
    if (const std::size_t removed = all - points.size())
        account.say(counted(removed, "incomplete point"), " left out");
    if (points.size() < 2)
        refuse(file, ": ", counted(points.size(), "point"), "; give 2 or more");
    if (points.at(0) <= points.at(points.size() - 1))
        return points;
    account.say("x was decreasing, so the points were reversed");
    points.each_list([](auto& list) { std::reverse(list.begin(), list.end()); });
    return points;
}

Profile evenly_spaced(const Points& points, Index nodes, const std::string& file, ScanAccount& account) {
    const Evenness fit =
        points.spacing > 0 ? Evenness{0, points.spacing, 0, true} : evenness(points.x, points.last_digit);
    const Index all = static_cast<Index>(points.size());
    if (fit.even && (nodes == 0 || nodes == all)) {
        if (fit.deviation > 1e-9 * fit.spacing)
            account.say("x deviates from even spacing by up to ", fit.deviation,
                        " mm because of rounding and is treated as even");
        return {Eigen::Map<const Eigen::VectorXd>(points.heights.data(), all), fit.spacing};
    }
    std::vector<double> x = points.x;
    x.resize(points.size());
    if (fit.even)
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = fit.first + fit.spacing * static_cast<double>(i);
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            refuse(at(file, points.line_of(i)), ": x does not grow (", x[i], " mm after ", x[i - 1],
                   " mm); put the points in order of x");
    if (!fit.even) {
        std::vector<double> steps(x.size());
        std::adjacent_difference(x.begin(), x.end(), steps.begin());
        const auto [shortest, longest] = std::minmax_element(steps.begin() + 1, steps.end());
        account.say("spacing uneven (", *shortest, " to ", *longest, " mm)");
    }
    const Index count = nodes == 0 ? all : nodes;
    account.say("resampled linearly to ", count, " evenly spaced nodes");
    return resampled(x, points.heights, count);
}

/// Finds outliers and, if `remove` is set, replaces them. Returns the ones that are kept.
std::vector<Index> take_outliers(Profile& profile, bool remove, ScanAccount& account) {
    std::vector<Index> found = outliers(profile.heights);
    if (found.empty())
        return found;
    account.say(counted(found.size(), "outlier"), " (", found.size() == 1 ? "at" : "from",
                " x = ", profile.spacing * static_cast<double>(found.front()), " mm) ",
                remove ? "replaced linearly" : "kept");
    if (!remove)
        return found;
    profile.heights = interpolated(profile.heights, found);
    return {};
}

void check(const ScanOptions& options) {
    for (const auto& [length, name] :
         {std::pair(options.spacing, "spacing"), std::pair(options.lambda_s, "lambda-s"),
          std::pair(options.lambda_c, "lambda-c")})
        if (!(length >= 0) || !std::isfinite(length))
            refuse_value(name, length, " is out of range (a length above 0)");
    if (options.lambda_c > 0 && options.lambda_s >= options.lambda_c)
        refuse_value("lambda-s", options.lambda_s, " mm is out of range (less than lambda-c, ",
                     options.lambda_c, " mm)");
    if (options.row < 0)
        refuse("row: ", options.row, " is out of range (1 or more)");
    if (options.nodes != 0 && (options.nodes < 2 || options.nodes > 10'000'000))
        refuse("nodes: ", options.nodes, " is out of range (2 to 1e7)");
}

} // namespace

Scan open_scan(const std::filesystem::path& path, const ScanOptions& options) {
    check(options);
    const std::string file = path.string();
    std::string bytes = read_whole(path, max_file_bytes, [&](std::string_view head) {
        if (!is_binary_map(head))
            expect_text(head, file);
    });
    ScanAccount account;
    Points points;
    if (const auto map = binary_map(bytes, file)) {
        points = points_of(*map, options, file, account);
    } else {
        const auto lines = text_lines(bytes, file);
        const auto named = text_map(lines, file);
        points = named ? points_of(*named, options, file, account) : points_of(lines, options, file, account);
    }
    const std::size_t read = points.size();
    points = in_order(std::move(points), options.fill, file, account);

    Profile profile = evenly_spaced(points, options.nodes, file, account);
    const double size = profile.heights.cwiseAbs().maxCoeff();
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    if (!std::isfinite(size * size) || !std::isfinite(length))
        refuse(file, ": heights up to ", size, " mm over ", length,
               " mm, too large for double precision; check the unit");
    std::vector<Index> kept = take_outliers(profile, options.remove_outliers, account);
    profile.heights = detrended(profile, options.detrend);
    const std::string removed = options.detrend == Detrend::none ? "nothing" : name_of(options.detrend);
    account.say("form removed from the heights: ", removed);
    if (options.lambda_s > 0) {
        profile.heights = low_passed(profile, options.lambda_s);
        account.say("waves under lambda_s = ", options.lambda_s, " mm removed");
    }
    if (options.lambda_c > 0) {
        profile.heights -= low_passed(profile, options.lambda_c);
        account.say("waves over lambda_c = ", options.lambda_c, " mm removed");
    }
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    if (!(range > 1e-12 * size))
        refuse(file, ": the heights are constant (", removed, " removed); give a rough profile");
    const double rms = std::sqrt((profile.heights.array() - profile.heights.mean()).square().mean());
    return {.name = file,
            .measured = std::move(profile),
            .account =
                line_with_digits(6, file, ": ", counted(read, "point"), ", length ", length,
                                 " mm, height range ", range, " mm, rms ", rms, " mm; ", account.text.str()),
            .outliers = std::move(kept)};
}

Grid Scan::grid(bool periodic) const {
    const Index nodes = measured.nodes();
    return {nodes, measured.spacing * static_cast<double>(periodic ? nodes : nodes - 1), periodic};
}

Profile Scan::on(const Grid& wanted) const {
    if (wanted.nodes != measured.nodes())
        throw InputError(
            line_of(name, ": a grid of ", wanted.nodes, " nodes; use the scan's ", measured.nodes()),
            "nodes");
    Profile profile = measured;
    if (wanted.length != grid(wanted.periodic).length)
        profile.spacing = wanted.spacing();
    return profile;
}

} // namespace rough
