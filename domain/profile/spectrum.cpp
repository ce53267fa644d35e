#include "domain/profile/spectrum.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"

#include <cmath>
#include <numbers>

namespace rough {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Hann's window, or none.
Eigen::ArrayXd window(Index nodes, bool periodic) {
    Eigen::ArrayXd window = Eigen::ArrayXd::Ones(nodes);
    for (Index i = 0; !periodic && i < nodes; ++i)
        window[i] = 0.5 - 0.5 * std::cos(turn * static_cast<double>(i) / static_cast<double>(nodes));
    return window;
}

} // namespace

Eigen::ArrayXXd wave_powers(const Profile& surface, bool periodic) {
    const auto [columns, rows] = surface.shape();
    if (columns < 4 || (rows < 4 && surface.is_2d()))
        refuse("spectrum: a surface of ", columns, " x ", rows, " nodes; use at least 4 along each side");
    const Eigen::ArrayXd along_x = window(columns, periodic), along_y = window(rows, periodic || rows == 1);
    const Eigen::ArrayXXd windowed = (along_x.matrix() * along_y.matrix().transpose()).array() *
                                     (surface.heights.array() - surface.heights.mean()).reshaped(columns, rows);
    const double scale = 1 / (static_cast<double>(surface.nodes()) * along_x.square().sum() * along_y.square().sum());
    Eigen::ArrayXXd power = 2 * scale * fourier_transform(windowed).abs2();
    power.row(0) /= 2; // no wave of -q is added to it
    if (columns % 2 == 0) power.bottomRows(1) /= 2;
    return power;
}

Spectrum continuous_spectrum(const Profile& surface, bool periodic) {
    const Eigen::ArrayXXd powers = wave_powers(surface, periodic);
    const auto [columns, rows] = surface.shape();
    const double dx = turn / (surface.spacing * static_cast<double>(columns));
    if (!surface.is_2d()) {
        const Index half = columns / 2;
        const Eigen::VectorXd power = powers.col(0).tail(half);
        return {dx * Eigen::VectorXd::LinSpaced(half, 1, static_cast<double>(half)), power / dx, power};
    }
    const double dy = turn / (surface.row_spacing * static_cast<double>(rows)), width = std::max(dx, dy);
    const auto ring = [&](double q) { return std::lround(q / width) - 1; };
    const double highest = std::hypot(dx * static_cast<double>(columns / 2), dy * static_cast<double>(rows / 2));
    const Index rings = ring(highest) + 1;
    Eigen::VectorXd power = Eigen::VectorXd::Zero(rings), squares = power, waves = power;
    for (Index j = 0; j < rows; ++j)
        for (Index i = 0; i < powers.rows(); ++i) {
            const double q = std::hypot(dx * static_cast<double>(i), dy * static_cast<double>(std::min(j, rows - j)));
            const Index k = std::max<Index>(ring(q), 0); // the first ring takes longer waves along the longer side
            if (q == 0) continue;
            power[k] += powers(i, j);
            squares[k] += powers(i, j) * q * q;
            waves[k] += i == 0 || 2 * i == columns ? 1 : 2;
        }
    Spectrum spectrum{Eigen::VectorXd(rings), power.array() / waves.array().max(1) / (dx * dy), power};
    for (Index k = 0; k < rings; ++k)
        spectrum.wave_number[k] = power[k] > 0 ? std::sqrt(squares[k] / power[k]) : width * static_cast<double>(k + 1);
    return spectrum;
}

} // namespace rough
