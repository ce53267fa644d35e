#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace rough {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int directions = 180; ///< one degree apart
constexpr double decayed = 0.2; ///< ISO 25178-3's default

/// Autocorrelation at lags from 0 to half of each side, along y also at negative lags.
class Autocorrelation {
  public:
    Autocorrelation(const Profile& map, bool periodic)
        : columns_(map.shape().columns / 2), rows_(map.shape().rows / 2),
          values_(columns_ + 1, 2 * rows_ + 1) {
        const auto [columns, rows] = map.shape();
        const Extent padded =
            periodic ? map.shape()
                     : Extent{fast_fourier_length(columns + columns_), fast_fourier_length(rows + rows_)};
        Eigen::ArrayXXd z = Eigen::ArrayXXd::Zero(padded.columns, padded.rows);
        z.topLeftCorner(columns, rows) = map.heights.reshaped(columns, rows).array() - map.heights.mean();
        const Eigen::ArrayXXd sums = inverse_fourier_transform(
            fourier_transform(z).abs2().cast<std::complex<double>>(), padded.columns);
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
        if (x < 0)
            x = -x, y = -y;
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
            if (now <= decayed)
                return r - step * (decayed - now) / (before - now);
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
            const double x = dx * static_cast<double>(i),
                         y = dy * static_cast<double>(2 * j > rows ? j - rows : j);
            if ((x == 0 && y == 0) || powers(i, j) <= negligible)
                continue;
            const double across = (std::atan2(y, x) + pi / 2) * directions / pi, // degrees
                reach = std::clamp(std::max(dx, dy) / std::hypot(x, y) * directions / pi, 1.0, 90.0);
            for (Index k = std::lround(std::ceil(across - reach));
                 k <= std::lround(std::floor(across + reach)); ++k)
                angular[(k + 2 * directions) % directions] +=
                    powers(i, j) / reach * (1 + std::cos(pi * (static_cast<double>(k) - across) / reach));
        }
    Index highest = 0;
    angular.maxCoeff(&highest);
    return static_cast<double>(highest);
}

} // namespace

Texture texture(const Profile& map, bool periodic) {
    Texture result;
    result.Std = lay(map, periodic);
    const Autocorrelation correlation(map, periodic);
    double fastest = std::numeric_limits<double>::infinity(), slowest = 0;
    for (int k = 0; k < directions; ++k) {
        const double length = correlation.decay_length(pi * k / directions, map.spacing, map.row_spacing);
        if (length > 0)
            fastest = std::min(fastest, length);
        if (std::abs(length) > slowest) {
            slowest = std::abs(length);
            result.Str_is_bound = length < 0;
        }
    }
    const bool decays = std::isfinite(fastest);
    result.Sal = decays ? fastest : std::numeric_limits<double>::quiet_NaN();
    result.Str = decays ? fastest / slowest : std::numeric_limits<double>::quiet_NaN();
    return result;
}

ArealParameters areal_parameters(const Profile& map, bool periodic) {
    constexpr Index min_nodes = 10;
    const auto [columns, rows] = map.shape();
    if (!map.is_2d() || columns < min_nodes || rows < min_nodes)
        refuse("areal parameters: a map of ", columns, " x ", rows, " nodes; use at least 10 x 10");
    Profile about = map;
    about.heights.array() -= map.heights.mean();
    const Eigen::ArrayXd z = about.heights.array();
    const double Sq = std::sqrt(z.square().mean()), Sp = z.maxCoeff(), Sv = -z.minCoeff();
    if (!(Sq > 1e-14 * map.heights.cwiseAbs().maxCoeff()))
        refuse("areal parameters: the map is constant; use a rough one");
    const Derivatives slopes = derivatives(about, periodic);
    const Eigen::ArrayXXd squares = slopes.x.square() + slopes.y.square();
    const CoreHeights core = core_heights(about.heights);
    const Texture t = texture(about, periodic);
    return {{{{"Sa", "mm", "arithmetic mean height", z.abs().mean()},
              {"Sq", "mm", "root mean square height", Sq},
              {"Ssk", "", "skewness", (z / Sq).cube().mean()},
              {"Sku", "", "kurtosis", (z / Sq).square().square().mean()},
              {"Sp", "mm", "highest peak", Sp},
              {"Sv", "mm", "deepest pit", Sv},
              {"Sz", "mm", "maximum height", Sp + Sv},
              {"Sdq", "", "root mean square gradient", std::sqrt(squares.mean())},
              {"Sdr", "", "developed area over the map's, less 1", // sqrt(1 + g^2) - 1
               (squares / ((1 + squares).sqrt() + 1)).mean()},
              {"Sal", "mm", "autocorrelation length, to 0.2", t.Sal},
              {"Str", "",
               t.Str_is_bound ? "texture aspect ratio, at most" : "texture aspect ratio: 0 one lay, 1 none",
               t.Str},
              {"Std", "°", "direction of the lay, from x", t.Std},
              {"Smr", "", "material ratio at the mean plane", material_ratio(about, 0)},
              {"Smc10", "mm", "height that a tenth of the area exceeds", material_height(about.heights, 0.1)},
              {"Sk", "mm", "core height", core.Rk},
              {"Spk", "mm", "reduced peak height", core.Rpk},
              {"Svk", "mm", "reduced valley depth", core.Rvk},
              {"Smrk1", "", "material ratio above the core", core.Mr1},
              {"Smrk2", "", "material ratio above the valleys", core.Mr2}}},
            t.Str_is_bound};
}

} // namespace rough
