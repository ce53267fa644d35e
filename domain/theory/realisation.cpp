#include "domain/theory/realisation.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "ga/base/random.hpp"

#include <cmath>
#include <numbers>

namespace rough {

Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed) {
    random_surface(parameters); // refuses what is out of range
    if (!grid.wraps || grid.is_2d() != parameters.is_area)
        refuse(
            "self-affine surface: expected a grid that wraps, a line's for a profile, an area's for an area");
    const Extent shape = grid.shape();
    const double dx = 1 / grid.length, dy = grid.is_2d() ? 1 / grid.width : 0;
    const double least = (1 - 1e-12) / parameters.longest, most = (1 + 1e-12) / parameters.shortest;
    const auto last = static_cast<Index>(most / dx),
               last_row = grid.is_2d() ? static_cast<Index>(most / dy) : 0;
    AlignedBuffer<fftw_complex> waves(shape.nodes());
    for (Index k = 0; k < shape.nodes(); ++k)
        waves[k][0] = waves[k][1] = 0;
    ga::Stream random(ga::fold(seed, "self-affine surface"));
    double slopes = 0; // mean square
    for (Index j = -last_row; j <= last_row; ++j)
        for (Index i = j > 0 ? 0 : 1; i <= last; ++i) { // of q and -q one
            const double q = std::hypot(dx * static_cast<double>(i), dy * static_cast<double>(j));
            if (q < least || q > most)
                continue;
            const double amplitude = std::pow(q, -parameters.hurst - (parameters.is_area ? 1 : 0.5)),
                         phase = random.uniform(0, 2 * std::numbers::pi);
            slopes += std::pow(2 * std::numbers::pi * q * amplitude, 2) / 2;
            auto& wave = waves[(j + last_row * shape.rows) % shape.rows * shape.columns + i % shape.columns];
            wave[0] += amplitude * std::cos(phase);
            wave[1] += amplitude * std::sin(phase);
        }
    if (!(slopes > 0))
        refuse("self-affine surface: no wave of ", parameters.longest, " to ", parameters.shortest,
               " mm fits a surface of ", grid.length, " mm");
    fftw_execute_dft(complex_fourier_plan(shape).backward, waves.data(), waves.data());
    Profile surface{Eigen::VectorXd(shape.nodes()), grid.spacing(), shape.rows, grid.row_spacing()};
    const double scale = parameters.rms_slope / std::sqrt(slopes);
    for (Index k = 0; k < shape.nodes(); ++k)
        surface.heights[k] = scale * waves[k][0];
    return surface;
}

} // namespace rough
