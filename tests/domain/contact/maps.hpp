#pragma once

#include "domain/numerics/fourier.hpp"
#include "domain/profile/profile.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace maps {

/// Heights of a function of x and y, mm.
template <class Height>
rough::Profile map_of(rough::Extent shape, double spacing, double row_spacing, Height height) {
    rough::Profile map{Eigen::VectorXd(shape.nodes()), spacing, shape.rows, row_spacing};
    for (rough::Index j = 0; j < shape.rows; ++j)
        for (rough::Index i = 0; i < shape.columns; ++i)
            map.heights[j * shape.columns + i] =
                height(spacing * static_cast<double>(i), row_spacing * static_cast<double>(j));
    return map;
}

/// Root mean square gradient of a periodic map, by differences of neighbours.
inline double rms_slope(const rough::Profile& map) {
    const auto [columns, rows] = map.shape();
    double squares = 0;
    for (rough::Index j = 0; j < rows; ++j)
        for (rough::Index i = 0; i < columns; ++i) {
            const double z = map.heights[j * columns + i];
            squares += std::pow((map.heights[j * columns + (i + 1) % columns] - z) / map.spacing, 2) +
                       std::pow((map.heights[(j + 1) % rows * columns + i] - z) / map.row_spacing, 2);
        }
    return std::sqrt(squares / static_cast<double>(map.nodes()));
}

/// An isotropic periodic map with square cells, 1 mm long, with the Hurst exponent H. Waves from a quarter of
/// the shorter side down to 8 nodes have random phases; heights are scaled to an rms slope.
inline rough::Profile self_affine(rough::Extent shape, double H, unsigned seed, double slope) {
    using rough::Index;
    const auto [columns, rows] = shape;
    const Index half = columns / 2 + 1;
    Eigen::ArrayXXcd spectrum(half, rows);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    const double side = static_cast<double>(std::min(columns, rows));
    const auto waves = [side](Index k, Index n) { // on the shorter side
        return static_cast<double>(k) * (side / static_cast<double>(n));
    };
    for (Index j = 0; j < rows; ++j)
        for (Index i = 0; i < half; ++i) {
            const double q = std::hypot(waves(i, columns), waves(std::min(j, rows - j), rows));
            const double angle = phase(random);
            const double amplitude = q < 4 || q > side / 8 || (i == 0 && 2 * j > rows) ? 0 : std::pow(q, -1 - H);
            spectrum(i, j) = std::polar(amplitude, angle);
        }
    const double spacing = 1 / static_cast<double>(columns);
    rough::Profile map{rough::inverse_fourier_transform(spectrum, columns).reshaped(), spacing, rows, spacing};
    map.heights *= slope / rms_slope(map);
    return map;
}

/// A square one.
inline rough::Profile self_affine(rough::Index n, double H, unsigned seed, double slope) {
    return self_affine({n, n}, H, seed, slope);
}

} // namespace maps
