#include "domain/scan/scan.hpp"

#include "domain/errors.hpp"
#include "domain/profile/detrend.hpp"
#include "domain/profile/filter.hpp"
#include "domain/profile/outliers.hpp"
#include "domain/scan/height_map.hpp"
#include "domain/scan/table.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace rough {
namespace {

constexpr std::size_t no_column = static_cast<std::size_t>(-1);

/// A scan's points as the file gives them; NaN if a value is missing.
struct Points {
    double spacing = 0;    ///< mm; above 0: point i lies at i times that, and x and last_digit are empty
    std::vector<double> x; ///< mm
    std::vector<double> last_digit; ///< one unit in x's last written digit, mm
    std::vector<double> heights;    ///< mm
    std::vector<int> line;          ///< of the file; empty for a binary one

    std::size_t size() const { return heights.size(); } ///< points, missing ones too
    double at(std::size_t i) const {
        return spacing > 0 ? static_cast<double>(i) * spacing : x[i];
    }                                                                       ///< x, mm
    int line_of(std::size_t i) const { return line.empty() ? 0 : line[i]; } ///< 0: none
};

void refuse_missing(const Points& points, const std::string& file) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const bool has_x = !std::isnan(points.at(i)); !has_x || std::isnan(points.heights[i]))
            throw InputError(at(file, points.line_of(i)) + ": a missing value, expected " +
                                 (has_x ? "a height" : "an x") + ", or to fill it by interpolation",
                             "fill");
}

template <class Keep>
void keep_only(Points& points, Keep keep) {
    std::size_t kept = 0;
    const auto in_each_list = [&](auto change) {
        change(points.x), change(points.last_digit), change(points.heights), change(points.line);
    };
    for (std::size_t i = 0, all = points.size(); i < all; ++i)
        if (keep(i)) {
            in_each_list([&](auto& list) {
                if (!list.empty())
                    list[kept] = list[i];
            });
            ++kept;
        }
    in_each_list([&](auto& list) { list.resize(std::min(list.size(), kept)); });
}

/// Fills heights that are missing between two others, and removes points without x and those without height
/// at either end. Gives how many were filled.
std::size_t fill(Points& points) {
    const auto whole = [&](std::size_t i) {
        return !std::isnan(points.at(i)) && !std::isnan(points.heights[i]);
    };
    std::size_t first = 0, end = points.size();
    while (first < end && !whole(first))
        ++first;
    while (end > first && !whole(end - 1))
        --end;
    keep_only(points, [&](std::size_t i) { return first <= i && i < end && !std::isnan(points.at(i)); });
    std::size_t filled = 0;
    const auto measured = [&](std::size_t i) { return !std::isnan(points.heights[i]); };
    for (std::size_t left = 0, right = 1; right < points.size(); left = right++) {
        while (!measured(right))
            ++right;
        const double run = points.at(right) - points.at(left);
        for (std::size_t i = left + 1; i < right; ++i, ++filled) {
            const double share = run != 0 ? (points.at(i) - points.at(left)) / run : 0.5;
            points.heights[i] = points.heights[left] + share * (points.heights[right] - points.heights[left]);
        }
    }
    return filled;
}

/// How far points lie from even spacing, and the even spacing nearest to them.
struct Evenness {
    double first = 0;     ///< where the fitted even nodes start, in the unit of x
    double spacing = 0;   ///< least-squares spacing, > 0
    double deviation = 0; ///< largest distance of a point from its even node, in the unit of x
    bool even = false; ///< every point is within 1e-3 spacings, or within its last written digit, of its node
};

/// Whether the points are multiples of a spacing to the last bit, as those of a column of heights are: then
/// it is the spacing that was given, which a fit finds but for rounding.
bool are_multiples(const std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] != static_cast<double>(i) * x[1])
            return false;
    return x[1] > 0;
}

/// Fits even nodes to x (increasing, two points or more) by least squares over the index. last_digit: the
/// value of one unit in each point's last written digit, 0 if unknown.
Evenness evenness(const std::vector<double>& x, const std::vector<double>& last_digit) {
    if (are_multiples(x))
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
        // Rounding moves a point by half its last digit; the fit itself is moved by less than half as much
        // again.
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

/// What was read and done, told in one line.
struct Account {
    std::string text;
    void say(const std::string& part) { text += (text.empty() ? "" : "; ") + part; }
};

/// "1 point", "2 points".
std::string counted(std::size_t count, const std::string& of) {
    return std::to_string(count) + " " + of + (count == 1 ? "" : "s");
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

/// Whether the first column counts the rows.
bool has_running_index(const Table& table) {
    for (std::size_t i = 0; i < table.rows(); ++i)
        if (table.at(i, 0).value != table.at(0, 0).value + static_cast<double>(i) ||
            table.at(i, 0).last_digit != 1)
            return false;
    return table.rows() > 1;
}

/// Which columns hold what.
struct Layout {
    std::size_t x = no_column, height = 0, validity = no_column; ///< columns
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
        throw InputError(file + ": two columns, x and height; a spacing is for one column of heights");
    if (table.columns == 3 && header.validity_column && only_0_and_1(2))
        return {0, 1, 2};
    if (table.columns == 3 && has_running_index(table))
        return {1, 2};
    throw InputError(
        at(file, table.line[0]) + ": " + std::to_string(table.columns) +
            " columns, expected a line scan: heights, or x and height; or, of an areal matrix, the row to "
            "take" +
            (table.dialect.separator == Dialect::Separator::comma ? " (decimal commas need another separator)"
                                                                  : ""),
        "row");
}

/// A row of many heights as one column: the only one, or the one that is requested (1 the first).
void take_row(Table& table, Index requested, const std::string& file, Account& account) {
    if (requested == 0 && !(table.columns > 3 && table.rows() == 1))
        return;
    const auto row = static_cast<std::size_t>(std::max<Index>(requested, 1)) - 1;
    if (requested > 0) {
        const std::string size = line_of(table.rows(), " rows of ", table.columns, " heights");
        if (table.columns < 3 || row >= table.rows())
            throw InputError(
                line_of(file, ": row ", requested, " given of ", size, ", expected one of an areal matrix"),
                "row");
        account.say(line_of("row ", requested, " of ", size));
    }
    const auto first = table.cells.begin() + static_cast<std::ptrdiff_t>(row * table.columns);
    table.cells = {first, first + static_cast<std::ptrdiff_t>(table.columns)};
    table.line.assign(table.columns, table.line[row]);
    table.columns = 1;
}

/// The unit of each column: its header's, else the one given, else mm.
struct Units {
    LengthUnit x, height;
};

/// The unit or the two that were given; nothing where none was.
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
        throw InputError(file + ": its header gives " + what + " in " + named.name +
                         ", but the unit given is " + given.name);
}

Units units_of(const Header& header, const Layout& layout, const ScanOptions& options,
               const std::string& file, Account& account) {
    const auto named = [&](std::size_t column, const std::optional<LengthUnit>& by_key) {
        return column != no_column && column < header.units.size() && header.units[column]
                   ? header.units[column]
                   : by_key;
    };
    const bool has_x = layout.x != no_column;
    const auto x = named(layout.x, header.x_unit), height = named(layout.height, header.height_unit);
    const std::optional<Units> given = given_units(options);
    if (given && height && (!has_x || x)) {
        if (has_x)
            agree(*x, given->x, "x", file);
        agree(*height, given->height, "heights", file);
    }
    const auto expect_known = [&](std::size_t column, bool is_known) {
        if (!given && !is_known && column < header.unknown_units.size() &&
            !header.unknown_units[column].empty())
            throw InputError(file + ": a column in '" + header.unknown_units[column] +
                                 "', expected a known length unit there, or one given",
                             "unit");
    };
    expect_known(layout.x, x.has_value());
    expect_known(layout.height, height.has_value());
    const Units rest = given.value_or(Units{{"mm", 1}, {"mm", 1}});
    const std::string source = given ? " (given)" : " (assumed)";
    const Units units{x.value_or(rest.x), height.value_or(rest.height)};
    std::string said = has_x ? "x in " + units.x.name + (x ? "" : source) + ", " : "";
    said += "heights in " + units.height.name + (height ? "" : source);
    account.say(said);
    return units;
}

/// mm; 0: none
double spacing_given(const ScanOptions& options) {
    const auto units = given_units(options);
    return options.spacing * (units ? units->x.in_mm : 1);
}

void agree(double from_header, double given, const std::string& file) {
    if (given > 0 && from_header > 0 && std::abs(given - from_header) > 1e-3 * from_header)
        throw InputError(file + ": its header gives a spacing of " + short_number(from_header) +
                         " mm, but the spacing given is " + short_number(given) + " mm");
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
        throw InputError(file + ": one column of heights, expected a spacing with it", "spacing");
    return from_header > 0 ? from_header : given;
}

Points points_in_mm(const Table& table, const Header& header, const Layout& layout, const Units& units,
                    double spacing) {
    Points points;
    points.line = table.line;
    const bool even = layout.x == no_column;
    points.spacing = even ? spacing : 0;
    for (auto* list : {&points.heights, &points.x, &points.last_digit})
        list->reserve(even && list != &points.heights ? 0 : table.rows());
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double height = table.at(i, layout.height).value;
        const bool valid = layout.validity == no_column || table.at(i, layout.validity).value == 1;
        points.heights.push_back(valid ? height * header.height_factor * units.height.in_mm : std::nan(""));
        if (even)
            continue;
        points.x.push_back(table.at(i, layout.x).value * units.x.in_mm);
        points.last_digit.push_back(table.at(i, layout.x).last_digit * units.x.in_mm);
    }
    return points;
}

void say_announced(long announced, std::size_t found, Account& account) {
    if (announced >= 0 && announced != static_cast<long>(found))
        account.say(line_of("the file announces ", announced, " points"));
}

/// The row of a map that is asked for, or its only one.
Points points_of(const HeightMap& map, const ScanOptions& options, const std::string& file,
                 Account& account) {
    if (const auto units = given_units(options))
        agree(map.height_unit, units->height, "heights", file);
    agree(map.spacing, spacing_given(options), file);
    const std::string size = line_of(map.rows, " rows of ", map.columns(), " heights");
    if (map.rows == 1 && options.row > 0)
        throw InputError(file + ": a row given, expected none: " + map.format + " holds one profile", "row");
    if (map.rows > 1 && (options.row < 1 || options.row > map.rows))
        throw InputError(
            line_of(file, ": an areal map of ", size, ", expected the row to take, 1 to ", map.rows), "row");
    account.say(map.format + ", heights in " + map.height_unit.name +
                (map.rows > 1 ? "; row " + std::to_string(options.row) + " of " + size : ""));
    const Index first = map.columns() * std::max<Index>(options.row - 1, 0);
    Points points;
    points.spacing = map.spacing;
    for (Index i = first; i < first + map.columns(); ++i)
        points.heights.push_back(map.heights[i] * map.height_factor * map.height_unit.in_mm);
    if (!map.line.empty())
        points.line.assign(map.line.begin() + first, map.line.begin() + first + map.columns());
    say_announced(map.announced, points.size(), account);
    return points;
}

Points points_of(const std::vector<std::string_view>& lines, const ScanOptions& options,
                 const std::string& file, Account& account) {
    const bool spacing_named = std::any_of(lines.begin(), lines.end(), names_spacing);
    Table table = read_table(lines, file, options.spacing > 0 || spacing_named);
    const Header header = read_header(table, file);
    take_row(table, options.row, file, account);
    const Layout layout = layout_of(table, header, options.spacing > 0, file);
    const Units units = units_of(header, layout, options, file, account);
    const double spacing = layout.x == no_column ? spacing_of(header, options, table.rows(),
                                                              header.x_unit.value_or(units.height), file)
                                                 : 0;
    Points points = points_in_mm(table, header, layout, units, spacing);
    say_announced(table.announced, points.size(), account);
    if (table.announced == static_cast<long>(points.size()) && table.columns == 1)
        account.say("the first line is read as the number of points");
    return points;
}

/// The points without gaps, x growing from the first to the last.
Points in_order(Points points, bool fills, const std::string& file, Account& account) {
    if (!fills)
        refuse_missing(points, file);
    const std::size_t all = points.size();
    if (const std::size_t filled = fill(points))
        account.say(counted(filled, "missing height") + " filled linearly");
    if (const std::size_t left_out = all - points.size())
        account.say(counted(left_out, "incomplete point") + " left out");
    if (points.size() < 2)
        throw InputError(file + ": " + counted(points.size(), "point") + ", expected 2 or more");
    if (points.at(0) <= points.at(points.size() - 1))
        return points;
    account.say("x runs backwards, reversed");
    const auto reverse = [](auto& list) { std::reverse(list.begin(), list.end()); };
    reverse(points.x), reverse(points.heights), reverse(points.last_digit), reverse(points.line);
    return points;
}

Profile evenly_spaced(const Points& points, Index nodes, const std::string& file, Account& account) {
    const Evenness fit =
        points.spacing > 0 ? Evenness{0, points.spacing, 0, true} : evenness(points.x, points.last_digit);
    const Index all = static_cast<Index>(points.size());
    if (fit.even && (nodes == 0 || nodes == all)) {
        if (fit.deviation > 1e-9 * fit.spacing)
            account.say("spacing even within " + short_number(fit.deviation) +
                        " mm of rounding, read as evenly spaced; heights are unchanged");
        return {Eigen::Map<const Eigen::VectorXd>(points.heights.data(), all), fit.spacing};
    }
    std::vector<double> x = points.x;
    x.resize(points.size());
    if (fit.even)
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = fit.first + fit.spacing * static_cast<double>(i);
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            throw InputError(at(file, points.line_of(i)) + ": x does not grow (" + short_number(x[i]) +
                             " mm after " + short_number(x[i - 1]) + " mm), expected x in order");
    if (!fit.even) {
        std::vector<double> steps(x.size());
        std::adjacent_difference(x.begin(), x.end(), steps.begin());
        const auto [shortest, longest] = std::minmax_element(steps.begin() + 1, steps.end());
        account.say("spacing uneven (" + short_number(*shortest) + " to " + short_number(*longest) + " mm)");
    }
    const Index count = nodes == 0 ? all : nodes;
    account.say("resampled linearly to " + std::to_string(count) + " even nodes");
    return resampled(x, points.heights, count);
}

/// Finds what stands out, says so, and removes it if `remove` is set. Gives the nodes that are kept.
std::vector<Index> take_outliers(Profile& profile, bool remove, Account& account) {
    std::vector<Index> found = outliers(profile.heights);
    if (found.empty())
        return found;
    account.say(counted(found.size(), "outlier") +
                " (at x = " + short_number(profile.spacing * static_cast<double>(found.front())) +
                (found.size() == 1 ? " mm" : " mm and on") + ") " + (remove ? "replaced linearly" : "kept"));
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
            refuse_value(name, length, ", expected a length above 0");
    if (options.lambda_c > 0 && options.lambda_s >= options.lambda_c)
        refuse_value("lambda-s", options.lambda_s, " mm, expected less than lambda-c, ", options.lambda_c,
                     " mm");
    if (options.row < 0)
        refuse("row: ", options.row, ", expected 1 or more");
    if (options.nodes != 0 && (options.nodes < 2 || options.nodes > 10'000'000))
        refuse("nodes: ", options.nodes, ", expected 2 to 1e7");
}

} // namespace

Scan read_scan(const std::filesystem::path& path, const ScanOptions& options) {
    check(options);
    const std::string file = path.string();
    std::string bytes = read_whole(path, most_bytes, [&](std::string_view head) {
        if (!is_binary_map(head))
            expect_text(head, file);
    });
    Account account;
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
        throw InputError(file + ": heights up to " + short_number(size) + " mm over " + short_number(length) +
                         " mm, expected lengths whose squares fit double precision");
    std::vector<Index> kept = take_outliers(profile, options.remove_outliers, account);
    profile.heights = detrended(profile, options.detrend);
    const std::string removed =
        (options.detrend == Detrend::none ? "nothing" : std::string(name_of(options.detrend))) + " removed";
    account.say(removed);
    if (options.lambda_s > 0) {
        profile.heights = low_passed(profile, options.lambda_s);
        account.say("waves under lambda_s = " + short_number(options.lambda_s) + " mm taken off");
    }
    if (options.lambda_c > 0) {
        profile.heights -= low_passed(profile, options.lambda_c);
        account.say("waves over lambda_c = " + short_number(options.lambda_c) + " mm taken off");
    }
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    if (!(range > 1e-12 * size))
        throw InputError(file + ": the heights are constant (" + removed + "), expected a rough profile");
    const double rms = std::sqrt((profile.heights.array() - profile.heights.mean()).square().mean());
    return {std::move(profile),
            file + ": " + counted(read, "point") + ", length " + short_number(length) + " mm, height range " +
                short_number(range) + " mm, rms " + short_number(rms) + " mm; " + account.text,
            std::move(kept)};
}

} // namespace rough
