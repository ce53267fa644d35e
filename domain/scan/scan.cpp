#include "domain/scan/scan.hpp"

#include "domain/errors.hpp"
#include "domain/profile/outliers.hpp"
#include "domain/scan/surface_file.hpp"

#include <numeric>

namespace rough {
namespace {

/// A scan's points as the file gives them; NaN if a value is missing.
struct Points {
    double spacing = 0;          ///< mm; if above 0, point i is at i times this, and x is empty
    Rounding rounding;           ///< rounding of x, mm
    std::vector<double> x;       ///< mm
    std::vector<double> heights; ///< mm
    std::vector<int> line;       ///< in the file; empty for a binary one

    std::size_t size() const { return heights.size(); } ///< missing points included
    double at(std::size_t i) const { return spacing > 0 ? static_cast<double>(i) * spacing : x[i]; } ///< mm
    int line_of(std::size_t i) const { return line.empty() ? 0 : line[i]; }                          ///< 0: none
    bool is_whole(std::size_t i) const { return !std::isnan(at(i)) && !std::isnan(heights[i]); }
    void each_list(auto change) { change(x), change(heights), change(line); }
};

/// Removes points without x, and points without height at either end.
void remove_incomplete(Points& points) {
    std::size_t first = 0, end = points.size(), kept = 0;
    while (first < end && !points.is_whole(first)) ++first;
    while (end > first && !points.is_whole(end - 1)) --end;
    for (std::size_t i = first; i < end; ++i) {
        points.each_list([&](auto& list) {
            if (!list.empty()) list[kept] = list[i];
        });
        kept += !std::isnan(points.at(kept));
    }
    points.each_list([&](auto& list) { list.resize(std::min(list.size(), kept)); });
}

/// Fills missing heights on the straight lines between their neighbours.
void fill(Points& points) {
    for (std::size_t left = 0, right = 1; right < points.size(); left = right++) {
        while (std::isnan(points.heights[right])) ++right;
        const double run = points.at(right) - points.at(left);
        for (std::size_t i = left + 1; i < right; ++i) {
            const double share = run != 0 ? (points.at(i) - points.at(left)) / run : 0.5;
            points.heights[i] = points.heights[left] + share * (points.heights[right] - points.heights[left]);
        }
    }
}

/// Heights at `nodes` even nodes from the first to the last of strictly increasing x, linear between them.
Profile resampled(const std::vector<double>& x, const std::vector<double>& heights, Index nodes) {
    Profile profile{Eigen::VectorXd(nodes), (x.back() - x.front()) / static_cast<double>(nodes - 1)};
    std::size_t right = 1;
    for (Index i = 0; i < nodes; ++i) {
        const double at = std::min(x.front() + static_cast<double>(i) * profile.spacing, x.back());
        while (right + 1 < x.size() && x[right] < at) ++right;
        const double share = (at - x[right - 1]) / (x[right] - x[right - 1]);
        profile.heights[i] = heights[right - 1] + share * (heights[right] - heights[right - 1]);
    }
    return profile;
}

/// The rows of a matrix, as heights of cells along a side, on `count` cells of the same length.
Eigen::MatrixXd on_cells(const Eigen::MatrixXd& measured, Index count) {
    const double ratio = static_cast<double>(measured.rows()) / static_cast<double>(count);
    const auto at = [&](double node) -> Eigen::RowVectorXd {
        const Index left = std::clamp<Index>(static_cast<Index>(node), 0, measured.rows() - 2);
        const double share = node - static_cast<double>(left);
        return (1 - share) * measured.row(left) + share * measured.row(left + 1);
    };
    Eigen::MatrixXd cells = Eigen::MatrixXd::Zero(count, measured.cols());
    for (Index i = 0; i < count; ++i) {
        const double from = static_cast<double>(i) * ratio - 0.5, to = from + ratio; // in measured nodes
        if (ratio <= 1) cells.row(i) = at((from + to) / 2);
        for (double next = 0, begin = from; ratio > 1 && begin < to; begin = next) {
            next = std::min(std::floor(begin) + 1, to);
            cells.row(i) += (next - begin) / ratio * at((begin + next) / 2);
        }
    }
    return cells;
}

/// A map on other cells of the same area, as ScanOptions::nodes states.
Profile resampled(const Profile& map, Extent cells) {
    const auto [columns, rows] = map.shape();
    const Eigen::MatrixXd along_x = on_cells(map.heights.reshaped(columns, rows), cells.columns);
    return {on_cells(along_x.transpose(), cells.rows).transpose().reshaped(),
            map.spacing * static_cast<double>(columns) / static_cast<double>(cells.columns), cells.rows,
            map.row_spacing * static_cast<double>(rows) / static_cast<double>(cells.rows)};
}

/// Adds a part to the account of a scan; its numbers have six digits.
template <class... Parts>
void say(std::string& account, const Parts&... parts) {
    account += (account.empty() ? "" : "; ") + line_with_digits(6, parts...);
}

/// "1 point", "2 points".
std::string counted(std::size_t count, const std::string& of) {
    return std::to_string(count) + " " + of + (count == 1 ? "" : "s");
}

/// The points of a profile, or of a map's requested row.
Points points_of(const HeightMap& map, const ScanOptions& options, const std::string& file, std::string& account) {
    const std::string size = line_of(map.rows, " rows of ", map.columns(), " heights");
    if (map.rows == 1 && options.row > 0)
        throw InputError(file + ": " + map.format + " contains one profile; omit the row", "row");
    if (map.rows > 1 && (options.row < 1 || options.row > map.rows))
        throw InputError(line_of(file, ": an areal map of ", size, "; give the row to take, 1 to ", map.rows,
                                 ", or give the map as a surface"),
                         "row");
    say(account, map.format.empty() ? "" : map.format + ", ", map.units,
        map.rows > 1 ? line_of("; row ", options.row, " of ", size) : "");
    const Index first = map.columns() * std::max<Index>(options.row - 1, 0);
    Points points{map.spacing, map.rounding, map.x, {}, {}};
    points.heights.assign(map.heights.begin() + first, map.heights.begin() + first + map.columns());
    if (!map.line.empty()) points.line.assign(map.line.begin() + first, map.line.begin() + first + map.columns());
    if (map.announced >= 0 && map.announced != map.columns())
        say(account, "the file announces ", map.announced, " points");
    return points;
}

/// Refuses missing points, of which the first is at `first`, or says how they are filled or listed.
void account_for(const MissingPoints& missing, bool is_2d, const std::string& first, const ScanOptions& options,
                 std::string& account) {
    if (!missing) return;
    if (!options.fill && !options.keep_missing)
        throw InputError(
            first + ": a missing value, one of " + in_words(missing, is_2d) + "; give a height, or fill it", "fill");
    if (options.fill) expect_fillable(missing, options.max_filled, is_2d, first);
    say(account, in_words(missing, is_2d), options.fill ? " filled" : ", filled for parameters only",
        is_2d ? " by Laplace's equation" : " linearly");
    if (missing.share > doubtful_fill) say(account, "warning: more than 5 % of the points are filled");
}

/// The points without gaps, x growing from the first to the last, and those that were missing.
Points in_order(Points points, const ScanOptions& options, MissingPoints& missing, const std::string& file,
                std::string& account) {
    const std::size_t all = points.size();
    std::size_t first = 0;
    while (first < all && points.is_whole(first)) ++first;
    const std::string place = first < all ? at(file, points.line_of(first)) : file;
    if (first < all && std::isnan(points.at(first)) && !options.fill && !options.keep_missing)
        throw InputError(place + ": a missing value; give an x, or fill it", "fill");
    remove_incomplete(points);
    const std::size_t kept = points.size();
    if (first < all && !options.fill && !options.keep_missing && (first == 0 || all - kept > 0))
        throw InputError(place + ": a missing value; give a height, or fill it", "fill");
    if (kept < 2) refuse(file, ": ", counted(kept, "point"), "; give 2 or more");
    if (points.at(0) > points.at(kept - 1)) {
        say(account, "x was decreasing, so the points were reversed");
        points.each_list([](auto& list) { std::reverse(list.begin(), list.end()); });
    }
    missing = missing_points(
        profile_of(points.heights, (points.at(kept - 1) - points.at(0)) / static_cast<double>(kept - 1)));
    account_for(missing, false, place, options, account);
    fill(points);
    if (all > kept) say(account, counted(all - kept, "incomplete point"), " left out");
    return points;
}

Profile evenly_spaced(const Points& points, Index nodes, const std::string& file, std::string& account) {
    const Evenness fit =
        points.spacing > 0 ? Evenness{0, points.spacing, 0, true} : evenness(points.x, points.rounding);
    const Index all = static_cast<Index>(points.size());
    if (fit.even && (nodes == 0 || nodes == all)) {
        if (fit.deviation > 1e-9 * fit.spacing)
            say(account, "x deviates from even spacing by up to ", fit.deviation,
                " mm because of rounding and is treated as even");
        return {Eigen::Map<const Eigen::VectorXd>(points.heights.data(), all), fit.spacing};
    }
    std::vector<double> x = points.x;
    x.resize(points.size());
    if (fit.even)
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = fit.first + fit.spacing * static_cast<double>(i);
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            refuse(at(file, points.line_of(i)), ": x does not grow (", x[i], " mm after ", x[i - 1],
                   " mm); put the points in order of x");
    if (!fit.even) {
        std::vector<double> steps(x.size());
        std::adjacent_difference(x.begin(), x.end(), steps.begin());
        const auto [shortest, longest] = std::minmax_element(steps.begin() + 1, steps.end());
        say(account, "spacing uneven (", *shortest, " to ", *longest, " mm)");
    }
    const Index count = nodes == 0 ? all : nodes;
    say(account, "resampled linearly to ", count, " evenly spaced nodes");
    return resampled(x, points.heights, count);
}

/// Finds outliers and, if `remove` is set, replaces them. Returns the ones that are kept.
std::vector<Index> take_outliers(Profile& surface, bool remove, std::string& account) {
    std::vector<Index> found = outliers(surface);
    if (found.empty()) return found;
    Profile clean = without(surface, found);
    const double change = (clean.heights - surface.heights).cwiseAbs().maxCoeff(),
                 range = surface.heights.maxCoeff() - surface.heights.minCoeff();
    const Index first = found.front(), columns = surface.shape().columns;
    const std::string place = surface.is_2d()
                                  ? line_of("row ", first / columns + 1, ", column ", first % columns + 1)
                                  : line_with_digits(6, "x = ", surface.spacing * static_cast<double>(first), " mm");
    say(account, counted(found.size(), "outlier"), " (", found.size() == 1 ? "at " : "from ", place, ") ",
        !remove           ? "kept"
        : surface.is_2d() ? "replaced by Laplace's equation"
                          : "replaced linearly",
        ", up to ", change, " mm or ", line_with_digits(3, 100 * change / range), " % of the range");
    if (!remove) return found;
    surface = std::move(clean);
    return {};
}

void check(const ScanOptions& options) {
    for (const auto& [length, name] : {std::pair(options.spacing, "spacing"), std::pair(options.lambda_s, "lambda-s"),
                                       std::pair(options.lambda_c, "lambda-c")})
        if (!(length >= 0) || !std::isfinite(length)) refuse_value(name, length, " is out of range (a length above 0)");
    if (options.lambda_c > 0 && options.lambda_s >= options.lambda_c)
        refuse_value("lambda-s", options.lambda_s, " mm is out of range (less than lambda-c, ", options.lambda_c,
                     " mm)");
    if (options.row < 0) refuse("row: ", options.row, " is out of range (1 or more)");
    const auto [nodes, rows] = options.nodes;
    if (nodes != 0 && (nodes < 2 || nodes > 10'000'000)) refuse("nodes: ", nodes, " is out of range (2 to 1e7)");
}

/// Removes the form and the wavelengths outside of the cut-offs, and states it.
void prepare(Profile& surface, const ScanOptions& options, std::string& account) {
    surface.heights = detrended(surface, options.detrend);
    if (surface.is_2d() && options.detrend == Detrend::line)
        say(account, "its plane removed");
    else
        say(account,
            "form removed from the heights: ", options.detrend == Detrend::none ? "nothing" : name_of(options.detrend));
    if (options.lambda_s > 0) {
        surface.heights = low_passed(surface, options.lambda_s);
        say(account, "waves under lambda_s = ", options.lambda_s, " mm removed");
    }
    if (options.lambda_c > 0) {
        surface.heights -= low_passed(surface, options.lambda_c);
        say(account, "waves over lambda_c = ", options.lambda_c, " mm removed");
    }
}

} // namespace

bool holds_map(const std::filesystem::path& file, const ScanOptions& options) {
    std::string account;
    try {
        points_of(read_heights(file, options, false), options, file.string(), account);
        return false;
    } catch (const InputError& fault) {
        return fault.about == "row" && options.row == 0;
    }
}

Scan open_scan(const std::filesystem::path& path, const ScanOptions& options) {
    check(options);
    const std::string file = path.string();
    std::string account;
    MissingPoints missing;
    Points points = points_of(read_heights(path, options, false), options, file, account);
    const std::size_t read = points.size();
    points = in_order(std::move(points), options, missing, file, account);

    Profile profile = evenly_spaced(points, options.nodes.columns, file, account);
    if (missing) { // a node is missing if a missing point decides its height
        std::vector<double> marks(points.size(), 0);
        for (const Index node : missing.nodes) marks[static_cast<std::size_t>(node)] = 1;
        points.heights = std::move(marks);
        std::string none;
        const Profile marked = evenly_spaced(points, options.nodes.columns, file, none);
        missing.nodes.clear();
        for (Index node = 0; node < marked.nodes(); ++node)
            if (marked.heights[node] > 0) missing.nodes.push_back(node);
    }
    const double size = profile.heights.cwiseAbs().maxCoeff();
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    if (!std::isfinite(size * size) || !std::isfinite(length))
        refuse(file, ": heights up to ", size, " mm over ", length,
               " mm, too large for double precision; check the unit");
    std::vector<Index> kept = take_outliers(profile, options.remove_outliers, account);
    prepare(profile, options, account);
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    if (!(range > 1e-12 * size))
        refuse(file, ": the heights are constant (", name_of(options.detrend), " removed); give a rough profile");
    const double rms = std::sqrt((profile.heights.array() - profile.heights.mean()).square().mean());
    return {.name = file,
            .measured = std::move(profile),
            .account = line_with_digits(6, file, ": ", counted(read, "point"), ", length ", length,
                                        " mm, height range ", range, " mm, rms ", rms, " mm; ", account),
            .outliers = std::move(kept),
            .missing = std::move(missing)};
}

Scan read_map(const std::filesystem::path& path, const ScanOptions& options) {
    check(options);
    const std::string file = path.string();
    HeightMap read = read_heights(path, options, true);
    const Extent shape{read.columns(), read.rows};
    if (shape.columns < 2 || shape.rows < 2)
        refuse(file, ": ", shape.rows, " rows of ", shape.columns, " heights; give a matrix of 2 x 2 or more");
    Scan map{file, {std::move(read.heights), read.spacing, shape.rows, read.row_spacing}};
    Profile& surface = map.measured;
    if (!std::isfinite(surface.spacing * static_cast<double>(surface.nodes()) * surface.row_spacing))
        refuse_value("spacing", surface.spacing, " mm x ", surface.row_spacing,
                     " mm is too large for an area; check the unit");
    std::string& account = map.account;
    say(account, "a map of ", shape.columns, " x ", shape.rows, " heights; ", read.format, ", ", read.units);
    map.missing = missing_points(surface);
    if (map.missing) {
        const Index first = map.missing.nodes.front();
        const auto node = static_cast<std::size_t>(first);
        account_for(map.missing, true,
                    line_of(read.line.empty() ? file + ": row " + std::to_string(first / shape.columns + 1)
                                              : at(file, read.line[node]),
                            ", column ", first % shape.columns + 1),
                    options, account);
        surface = filled(std::move(surface), map.missing);
    }
    if (const Extent cells = options.nodes; cells.columns != 0 && cells != shape) {
        if (cells.rows < 2) refuse("nodes: ", cells.rows, " along y is out of range (2 or more)");
        Profile missing{Eigen::VectorXd::Zero(surface.nodes()), surface.spacing, surface.rows, surface.row_spacing};
        missing.heights(map.missing.nodes).setOnes();
        missing.heights = resampled(missing, cells).heights;
        map.missing.nodes.clear();
        for (Index node = 0; node < missing.nodes(); ++node)
            if (missing.heights[node] != 0) map.missing.nodes.push_back(node);
        surface = resampled(surface, cells);
        say(account, "resampled to ", cells.columns, " x ", cells.rows, " cells");
    }
    map.outliers = take_outliers(surface, options.remove_outliers, account);
    prepare(surface, options, account);
    return map;
}

Profile Scan::on(const Grid& wanted) const {
    if (wanted.nodes != measured.nodes())
        throw InputError(line_of(name, ": a grid of ", wanted.nodes, " nodes; use the scan's ", measured.nodes()),
                         "nodes");
    Profile profile = measured;
    if (wanted.length != grid_of(measured, wanted.periodic).length) profile.spacing = wanted.spacing();
    return profile;
}

} // namespace rough
