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

/// An isotropic periodic map of 1 mm with the Hurst exponent H. Waves from L/4 down to 8 nodes have random
/// phases; heights are scaled to an rms slope.
inline rough::Profile self_affine(rough::Index n, double H, unsigned seed, double slope) {
    using rough::Index;
    const Index half = n / 2 + 1;
    Eigen::ArrayXXcd spectrum(half, n);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < half; ++i) {
            const double q = std::hypot(static_cast<double>(i), static_cast<double>(std::min(j, n - j)));
            const double angle = phase(random);
            const double amplitude =
                q < 4 || q > static_cast<double>(n) / 8 || (i == 0 && 2 * j > n) ? 0 : std::pow(q, -1 - H);
            spectrum(i, j) = std::polar(amplitude, angle);
        }
    const double spacing = 1 / static_cast<double>(n);
    rough::Profile map{rough::inverse_fourier_transform(spectrum, n).reshaped(), spacing, n, spacing};
    map.heights *= slope / rms_slope(map);
    return map;
}

} // namespace maps
