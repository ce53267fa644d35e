#include "domain/profile/roughness.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/profile/spectrum.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace rough {
namespace {

constexpr Index min_nodes = 10;

constexpr Index reach = 3;
constexpr std::array<double, 7> first{-1, 9, -45, 0, 45, -9, 1};        // divided by 60 delta
constexpr std::array<double, 7> second{2, -27, 270, -490, 270, -27, 2}; // divided by 180 delta^2

/// A derivative of a surface along x or y by a seven-point formula of ISO 21920-2, which is exact for
/// polynomials up to degree 6. It is computed at nodes three or more from every end.
Eigen::ArrayXXd derivative(const Eigen::ArrayXXd& z, bool along_y, const std::array<double, 7>& weights,
                           double divisor) {
    const Index across = z.cols() > 1 ? reach : 0, columns = z.rows() - 2 * reach, rows = z.cols() - 2 * across;
    Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(columns, rows);
    for (Index k = 0; k <= 2 * reach; ++k)
        sum += weights[static_cast<std::size_t>(k)] / divisor *
               (along_y ? z.block(reach, k, columns, rows) : z.block(k, across, columns, rows));
    return sum;
}

/// The nodes of the evaluation length, about their mean line, and its sections.
Profile evaluated(const Profile& profile, double section_length, Roughness& r) {
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    r.section_length = section_length > 0 ? section_length : length;
    const double sections = std::floor(length / r.section_length * (1 + 1e-9));
    if (!(sections >= 1))
        refuse("roughness: a profile of ", length, " mm is shorter than a section of ", section_length,
               " mm; use shorter sections");
    if (!(2 * sections <= static_cast<double>(profile.nodes())))
        refuse("roughness: sections of ", section_length, " mm have fewer than two nodes each; use longer sections");
    r.sections = static_cast<Index>(sections);
    const Index nodes =
        std::min<Index>(profile.nodes(), std::lround(sections * r.section_length / profile.spacing) + 1);
    Profile part{profile.heights.segment((profile.nodes() - nodes) / 2, nodes), profile.spacing};
    part.heights.array() -= part.heights.mean();
    return part;
}

/// A hill or a dale: its start on the mean line, in spacings, and its extreme height.
struct Stretch {
    double start;
    double extreme;
};

/// Hills and dales from left to right. Each exceeds a tenth of the largest height or depth, and starts at the
/// last crossing of the mean line before that.
std::vector<Stretch> stretches(const Eigen::VectorXd& z) {
    const double hill = z.maxCoeff() / 10, dale = z.minCoeff() / 10;
    std::vector<Stretch> found;
    double crossed = 0;
    int side = 0; // 1 after a hill, -1 after a dale
    for (Index i = 0; i < z.size(); ++i) {
        if (i > 0 && (z[i] > 0) != (z[i - 1] > 0)) crossed = static_cast<double>(i - 1) + z[i - 1] / (z[i - 1] - z[i]);
        const int now = z[i] > hill ? 1 : z[i] < dale ? -1 : 0;
        if (now != 0 && now != side) {
            found.push_back({crossed, z[i]});
            side = now;
        } else if (side * z[i] > 0 && std::abs(z[i]) > std::abs(found.back().extreme)) {
            found.back().extreme = z[i];
        }
    }
    return found;
}

/// Mean sizes of the profile elements. An element is a hill and a dale next to each other. It extends from one crossing
/// of the mean line to the next but one (ISO 21920-2: crossing-the-line segmentation, done from both ends).
struct ProfileElements {
    double RSm = 0; ///< mean width, mm; NaN without a whole element
    double Rc = 0;  ///< mean height from dale to hill, mm
};
ProfileElements profile_elements(const Profile& profile) {
    ProfileElements all;
    double count = 0;
    for (const bool backwards : {false, true}) {
        const auto found = stretches(backwards ? profile.heights.reverse().eval() : profile.heights);
        // The first may start before the profile, the last may end after it.
        for (std::size_t i = 1; i + 2 < found.size(); i += 2) {
            all.RSm += (found[i + 2].start - found[i].start) * profile.spacing;
            all.Rc += std::abs(found[i].extreme - found[i + 1].extreme);
            ++count;
        }
    }
    if (count == 0) count = std::numeric_limits<double>::quiet_NaN();
    return {all.RSm / count, all.Rc / count};
}

/// Appends the parameters of the material ratio curve (ISO 21920-2; ISO 13565-2), named by R or S and a
/// suffix. The line of least squares through the flattest 40 % of the curve, the first of equally flat ones,
/// separates peaks, core and valleys. Peaks and valleys are as high as triangles of their area.
void add_core(std::vector<SurfaceParameter>& rows, const std::string& kind, const Eigen::VectorXd& heights) {
    const Index n = heights.size();
    Eigen::VectorXd z = heights; // node i of the curve stands at (i + 1/2)/n
    std::sort(z.begin(), z.end(), std::greater<>());
    const double count = static_cast<double>(n);
    const Index window = std::clamp<Index>(std::lround(0.4 * count), 2, n);
    Index first = 0;
    const double range = z[0] - z[n - 1];
    for (Index i = 1; i + window <= n; ++i)
        if (z[i] - z[i + window - 1] < z[first] - z[first + window - 1] - 1e-12 * range) first = i;
    const Eigen::VectorXd core = z.segment(first, window);
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(window, -1, 1) * (static_cast<double>(window - 1) / 2 / count);
    const double slope = (t * core.array()).sum() / t.square().sum(); // per unit of share, <= 0
    const double middle = (static_cast<double>(first) + static_cast<double>(window) / 2) / count;
    const double upper = core.mean() - slope * middle, lower = upper + slope;

    // Share of material at which the curve, straight between its nodes, crosses a level.
    const auto crossing = [&](double level) {
        const Index above = std::lower_bound(z.begin(), z.end(), level, std::greater<>()) - z.begin();
        if (above == 0 || above == n) return static_cast<double>(above) / count;
        const double part = (z[above - 1] - level) / (z[above - 1] - z[above]);
        return (static_cast<double>(above) - 0.5 + part) / count;
    };
    const double Mr1 = crossing(upper), Mr2 = crossing(lower);
    const double peaks = (z.array() - upper).max(0).sum() / count, valleys = (lower - z.array()).max(0).sum() / count;
    rows.insert(rows.end(), {{kind + "k", "mm", "core height", upper - lower},
                             {kind + "pk", "mm", "reduced peak height", Mr1 > 0 ? 2 * peaks / Mr1 : 0},
                             {kind + "vk", "mm", "reduced valley depth", Mr2 < 1 ? 2 * valleys / (1 - Mr2) : 0},
                             {kind + "mrk1", "", "material ratio above the core", Mr1},
                             {kind + "mrk2", "", "material ratio above the valleys", Mr2}});
}

} // namespace

std::string SurfaceParameter::key() const {
    std::string key = name;
    std::replace(key.begin(), key.end(), ' ', '_');
    return key + (unit == "mm"      ? "_mm"
                  : unit == "1/mm"  ? "_per_mm"
                  : unit == "mm²"   ? "_mm2"
                  : unit == "1/mm²" ? "_per_mm2"
                  : unit == "°"     ? "_degrees"
                                    : "");
}

double SurfaceParameters::operator[](std::string_view name) const {
    const auto found = std::ranges::find(rows, name, &SurfaceParameter::name);
    if (found == rows.end()) refuse("surface parameter: ", name, " is not known; use a name of this table");
    return found->value;
}

double material_ratio(const Profile& profile, double level) {
    const Eigen::VectorXd& z = profile.heights;
    if (profile.is_2d()) return (z.array() > level).cast<double>().mean();
    double sum = 0;
    for (Index i = 1; i < z.size(); ++i) {
        const double low = std::min(z[i], z[i - 1]), high = std::max(z[i], z[i - 1]);
        sum += level <= low ? 1 : level >= high ? 0 : (high - level) / (high - low);
    }
    return sum / static_cast<double>(z.size() - 1);
}

double material_height(const Eigen::VectorXd& heights, double ratio) {
    return quantile({heights.begin(), heights.end()}, 1 - ratio);
}

Roughness roughness(const Profile& profile, double section_length) {
    if (profile.nodes() < min_nodes)
        refuse("roughness: a profile of ", profile.nodes(), " nodes; use at least ", min_nodes);
    Roughness r;
    const Profile part = evaluated(profile, section_length, r);
    if (part.nodes() < min_nodes)
        refuse("roughness: ", part.nodes(), " nodes in whole sections; use at least ", min_nodes);
    const Eigen::VectorXd& heights = part.heights;
    const Eigen::ArrayXd z = heights.array();
    const double m0 = z.square().mean(), Rq = std::sqrt(m0);
    if (!(Rq > 1e-14 * profile.heights.cwiseAbs().maxCoeff()))
        throw InputError("roughness: the profile is constant; use a rough one");
    double Rp = 0, Rv = 0;
    for (Index s = 0; s < r.sections; ++s) {
        const Index from = heights.size() * s / r.sections, to = heights.size() * (s + 1) / r.sections;
        Rp += heights.segment(from, to - from).maxCoeff() / static_cast<double>(r.sections);
        Rv -= heights.segment(from, to - from).minCoeff() / static_cast<double>(r.sections);
    }
    const ProfileElements elements = profile_elements(part);
    const double dx = part.spacing, m2 = derivative(z, false, first, 60 * dx).square().mean(),
                 m4 = derivative(z, false, second, 180 * dx * dx).square().mean(), bandwidth = m0 * m4 / (m2 * m2);
    const double Rsk = z.cube().mean() / (Rq * m0), Rku = z.square().square().mean() / (m0 * m0);
    if (!std::isfinite(Rsk + Rku + m2 + m4 + bandwidth))
        throw InputError(
            "roughness: its parameters do not fit double precision; use heights and a length nearer to 1 mm");
    const std::string of = r.sections > 1 ? ", mean of " + std::to_string(r.sections) + " sections" : "";
    r.rows = {{"Ra", "mm", "arithmetic mean height", z.abs().mean()},
              {"Rq", "mm", "root mean square height", Rq},
              {"Rsk", "", "skewness", Rsk},
              {"Rku", "", "kurtosis", Rku},
              {"Rp", "mm", "highest peak" + of, Rp},
              {"Rv", "mm", "deepest pit" + of, Rv},
              {"Rz", "mm", "maximum height" + of, Rp + Rv},
              {"Rt", "mm", "total height", z.maxCoeff() - z.minCoeff()},
              {"Rc", "mm", "mean height of the profile elements", elements.Rc},
              {"RSm", "mm", "mean width of the profile elements", elements.RSm},
              {"Rdq", "", "root mean square slope", std::sqrt(m2)},
              {"Rmr", "", "material ratio at the mean line", material_ratio(part, 0)}};
    add_core(r.rows, "R", heights);
    if (!(section_length > 0))
        for (SurfaceParameter& row : r.rows) row.name[0] = 'P';
    r.rows.insert(r.rows.end(), {{"rms curvature", "1/mm", "root mean square second derivative", std::sqrt(m4)},
                                 {"m0", "mm²", "spectral moments, from the nodes", m0},
                                 {"m2", "", "", m2},
                                 {"m4", "1/mm²", "", m4},
                                 {"bandwidth", "", "Nayak's alpha, m0 m4/m2²", bandwidth}});
    return r;
}

namespace {

using std::numbers::pi;
constexpr int directions = 180; ///< one degree apart
constexpr double decayed = 0.2; ///< ISO 25178-3's default

/// Autocorrelation at lags from 0 to half of each side, along y also at negative lags.
class Autocorrelation {
  public:
    Autocorrelation(const Profile& map, bool periodic)
        : columns_(map.shape().columns / 2), rows_(map.shape().rows / 2), values_(columns_ + 1, 2 * rows_ + 1) {
        const auto [columns, rows] = map.shape();
        const Extent padded =
            periodic ? map.shape() : Extent{fast_fourier_length(columns + columns_), fast_fourier_length(rows + rows_)};
        Eigen::ArrayXXd z = Eigen::ArrayXXd::Zero(padded.columns, padded.rows);
        z.topLeftCorner(columns, rows) = map.heights.reshaped(columns, rows).array() - map.heights.mean();
        const Eigen::ArrayXXd sums =
            inverse_fourier_transform(fourier_transform(z).abs2().cast<std::complex<double>>(), padded.columns);
        const auto overlap = [&](Index nodes, Index lag) {
            return periodic ? 1 : 1 - static_cast<double>(lag) / static_cast<double>(nodes);
        };
        for (Index j = -rows_; j <= rows_; ++j)
            for (Index i = 0; i <= columns_; ++i)
                values_(i, j + rows_) = sums(i, (j + padded.rows) % padded.rows) /
                                        (sums(0, 0) * overlap(columns, i) * overlap(rows, std::abs(j)));
    }

    /// Value at a lag in nodes, |x| and |y| up to half of the sides; linear in between.
    double at(double x, double y) const {
        if (x < 0) x = -x, y = -y;
        y += static_cast<double>(rows_);
        const Index i = std::min<Index>(static_cast<Index>(x), columns_ - 1),
                    j = std::clamp<Index>(static_cast<Index>(y), 0, 2 * rows_ - 1);
        const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
        return (1 - u) * ((1 - v) * values_(i, j) + v * values_(i, j + 1)) +
               u * ((1 - v) * values_(i + 1, j) + v * values_(i + 1, j + 1));
    }

    /// Lag in mm at which it has decayed in a direction; the negative lag of the edge if it has not by there.
    double decay_length(double angle, double dx, double dy) const {
        const double x = std::cos(angle) / dx, y = std::sin(angle) / dy; // nodes a mm
        const double edge = std::min(static_cast<double>(columns_) / std::max(std::abs(x), 1e-300),
                                     static_cast<double>(rows_) / std::max(std::abs(y), 1e-300));
        const double step = std::min(dx, dy) / 2;
        double before = 1;
        for (double r = step; r < edge; r += step) {
            const double now = at(r * x, r * y);
            if (now <= decayed) return r - step * (decayed - now) / (before - now);
            before = now;
        }
        return -edge;
    }

  private:
    Index columns_, rows_;
    Eigen::ArrayXXd values_;
};

/// The lay in degrees: the maximum of the angular spectrum. Each wave is spread over the angle of its width.
double lay(const Profile& map, bool periodic) {
    const Eigen::ArrayXXd powers = wave_powers(map, periodic);
    const auto [columns, rows] = map.shape();
    const double dx = 1 / (map.spacing * static_cast<double>(columns)),
                 dy = 1 / (map.row_spacing * static_cast<double>(rows));
    Eigen::ArrayXd angular = Eigen::ArrayXd::Zero(directions);
    const double negligible = 1e-14 * powers.sum();
    for (Index j = 0; j < rows; ++j)
        for (Index i = 0; i < powers.rows(); ++i) {
            const double x = dx * static_cast<double>(i), y = dy * static_cast<double>(2 * j > rows ? j - rows : j);
            if ((x == 0 && y == 0) || powers(i, j) <= negligible) continue;
            const double across = (std::atan2(y, x) + pi / 2) * directions / pi, // degrees
                reach = std::clamp(std::max(dx, dy) / std::hypot(x, y) * directions / pi, 1.0, 90.0);
            for (Index k = std::lround(std::ceil(across - reach)); k <= std::lround(std::floor(across + reach)); ++k)
                angular[(k + 2 * directions) % directions] +=
                    powers(i, j) / reach * (1 + std::cos(pi * (static_cast<double>(k) - across) / reach));
        }
    Index highest = 0;
    angular.maxCoeff(&highest);
    return static_cast<double>(highest);
}

/// Area of the surface through the nodes over that of the map, less 1. In each cell it is the mean area of
/// the two pairs of triangles, which the two diagonals make.
double developed_area(const Profile& map, bool periodic) {
    const auto [columns, rows] = map.shape();
    const Eigen::Map<const Eigen::ArrayXXd> z(map.heights.data(), columns, rows);
    const Index last = periodic ? 0 : 1;
    const double dx = map.spacing, dy = map.row_spacing;
    double sum = 0;
    for (Index j = 0; j + last < rows; ++j)
        for (Index i = 0; i + last < columns; ++i) {
            const Index right = (i + 1) % columns, up = (j + 1) % rows;
            const double x[]{(z(right, j) - z(i, j)) / dx, (z(right, up) - z(i, up)) / dx},
                y[]{(z(i, up) - z(i, j)) / dy, (z(right, up) - z(right, j)) / dy};
            for (const double a : x)
                for (const double b : y) { // sqrt(1 + g^2) - 1
                    const double square = a * a + b * b;
                    sum += square / (std::sqrt(1 + square) + 1) / 4;
                }
        }
    return sum / static_cast<double>((columns - last) * (rows - last));
}

} // namespace

Texture texture(const Profile& map, bool periodic) {
    Texture result;
    result.Std = lay(map, periodic);
    const Autocorrelation correlation(map, periodic);
    double fastest = std::numeric_limits<double>::quiet_NaN(), slowest = 0;
    for (int k = 0; k < directions; ++k) {
        const double length = correlation.decay_length(pi * k / directions, map.spacing, map.row_spacing);
        if (length > 0) fastest = std::fmin(fastest, length); // the number if one of both is NaN
        if (std::abs(length) > slowest) {
            slowest = std::abs(length);
            result.Str_is_bound = length < 0;
        }
    }
    result.Sal = fastest;
    result.Str = fastest / slowest;
    return result;
}

ArealParameters areal_parameters(const Profile& map, bool periodic) {
    const auto [columns, rows] = map.shape();
    if (!map.is_2d() || columns < min_nodes || rows < min_nodes)
        refuse("areal parameters: a map of ", columns, " x ", rows, " nodes; use at least 10 x 10");
    Profile about = map;
    about.heights.array() -= map.heights.mean();
    const Eigen::ArrayXd z = about.heights.array();
    const double Sq = std::sqrt(z.square().mean()), Sp = z.maxCoeff(), Sv = -z.minCoeff();
    if (!(Sq > 1e-14 * map.heights.cwiseAbs().maxCoeff()))
        refuse("areal parameters: the map is constant; use a rough one");
    Eigen::ArrayXXd relief = z.reshaped(columns, rows);
    if (periodic) // continued by three nodes on every side
        relief = z.reshaped(columns, rows)
                     .replicate(3, 3)
                     .block(columns - reach, rows - reach, columns + 2 * reach, rows + 2 * reach);
    const Eigen::ArrayXXd squares = derivative(relief, false, first, 60 * map.spacing).square() +
                                    derivative(relief, true, first, 60 * map.row_spacing).square();
    const Texture t = texture(about, periodic);
    ArealParameters s;
    s.Str_is_bound = t.Str_is_bound;
    s.rows = {{"Sa", "mm", "arithmetic mean height", z.abs().mean()},
              {"Sq", "mm", "root mean square height", Sq},
              {"Ssk", "", "skewness", (z / Sq).cube().mean()},
              {"Sku", "", "kurtosis", (z / Sq).square().square().mean()},
              {"Sp", "mm", "highest peak", Sp},
              {"Sv", "mm", "deepest pit", Sv},
              {"Sz", "mm", "maximum height", Sp + Sv},
              {"Sdq", "", "root mean square gradient", std::sqrt(squares.mean())},
              {"Sdr", "", "area of the surface (triangles) over the map's, less 1", developed_area(map, periodic)},
              {"Sal", "mm", "autocorrelation length, to 0.2", t.Sal},
              {"Str", "", t.Str_is_bound ? "texture aspect ratio, at most" : "texture aspect ratio: 0 one lay, 1 none",
               t.Str},
              {"Std", "°", "direction of the lay, from x", t.Std},
              {"Smr", "", "material ratio at the mean plane", material_ratio(about, 0)},
              {"Smc10", "mm", "height that a tenth of the area exceeds", material_height(about.heights, 0.1)}};
    add_core(s.rows, "S", about.heights);
    return s;
}

} // namespace rough
