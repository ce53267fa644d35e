#include "domain/theory/random_surface.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "ga/base/random.hpp"

#include <numbers>

namespace rough {

namespace {

/// int q^n C dq over the spectrum, for any directions of the waves.
double moment(const Spectrum& spectrum, int n) {
    return (spectrum.wave_number.array().pow(n) * spectrum.power.array()).sum();
}

/// int_from^to q^exponent dq
double power_integral(double exponent, double from, double to) {
    const double n = exponent + 1;
    return std::abs(n) < 1e-12 ? std::log(to / from) : (std::pow(to, n) - std::pow(from, n)) / n;
}

} // namespace

RandomSurface random_surface(const Profile& surface, bool periodic) {
    RandomSurface random{continuous_spectrum(surface, periodic), surface.is_2d()};
    if (!(random.spectrum.power.sum() > 0))
        refuse("theory: the surface is flat; give a rough one");
    return random;
}

RandomSurface random_surface(const SelfAffine& of) {
    if (!(of.hurst > 0 && of.hurst < 1))
        refuse("hurst: ", of.hurst, " is out of range (0 to 1, both excluded)");
    if (!(of.shortest > 0 && of.longest > of.shortest && std::isfinite(of.longest)))
        refuse("cut-offs: ", of.longest, " and ", of.shortest,
               " mm are not positive lengths in descending order; give the longer one first");
    if (!(of.rms_slope > 0) || !std::isfinite(of.rms_slope) || of.wave_numbers < 1)
        refuse("rms slope: ", of.rms_slope, " is out of range (above 0, finite)");
    RandomSurface random{{Eigen::VectorXd(of.wave_numbers), {}, Eigen::VectorXd(of.wave_numbers)},
                         of.is_area};
    const double lowest = 2 * std::numbers::pi / of.longest,
                 step = std::log(of.longest / of.shortest) / static_cast<double>(of.wave_numbers);
    for (Index k = 0; k < of.wave_numbers; ++k) {
        const double from = lowest * std::exp(step * static_cast<double>(k)), to = from * std::exp(step);
        // Around the circle a map's q^-2(1 + H) is a profile's q^-(1 + 2 H).
        const double heights = power_integral(-1 - 2 * of.hurst, from, to),
                     slopes = power_integral(1 - 2 * of.hurst, from, to);
        random.spectrum.power[k] = heights;
        random.spectrum.wave_number[k] = std::sqrt(slopes / heights);
    }
    random.spectrum.power *= of.rms_slope * of.rms_slope / moment(random.spectrum, 2);
    return random;
}

SpectralMoments spectral_moments(const RandomSurface& surface) {
    const double of_slope = surface.is_area ? 1.0 / 2 : 1, of_curvature = surface.is_area ? 3.0 / 8 : 1;
    return {moment(surface.spectrum, 0), of_slope * moment(surface.spectrum, 2),
            of_curvature * moment(surface.spectrum, 4)};
}

double rms_slope(const RandomSurface& surface) { return std::sqrt(moment(surface.spectrum, 2)); }

Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed) {
    random_surface(parameters); // refuses what is out of range
    if (!grid.periodic || grid.is_2d() != parameters.is_area)
        refuse("self-affine surface: the grid does not fit; give a periodic one, a line for a profile, a "
               "map for a map");
    const Extent shape = grid.shape();
    const double dx = 1 / grid.length, dy = grid.is_2d() ? 1 / grid.width : 0;
    const double lowest = (1 - 1e-12) / parameters.longest, largest = (1 + 1e-12) / parameters.shortest;
    const auto last = static_cast<Index>(largest / dx),
               last_row = grid.is_2d() ? static_cast<Index>(largest / dy) : 0;
    Eigen::ArrayXXcd waves = Eigen::ArrayXXcd::Zero(shape.columns, shape.rows);
    ga::Stream random(ga::fold(seed, "self-affine surface"));
    double slopes = 0; // mean square
    for (Index j = -last_row; j <= last_row; ++j)
        for (Index i = j > 0 ? 0 : 1; i <= last; ++i) { // one of q and -q
            const double q = std::hypot(dx * static_cast<double>(i), dy * static_cast<double>(j));
            if (q < lowest || q > largest)
                continue;
            const double amplitude = std::pow(q, -parameters.hurst - (parameters.is_area ? 1 : 0.5)),
                         phase = random.uniform(0, 2 * std::numbers::pi);
            slopes += std::pow(2 * std::numbers::pi * q * amplitude, 2) / 2;
            waves(i % shape.columns, (j + last_row * shape.rows) % shape.rows) +=
                std::polar(amplitude, phase);
        }
    if (!(slopes > 0))
        refuse("self-affine surface: no wave of ", parameters.longest, " to ", parameters.shortest,
               " mm fits a surface of ", grid.length, " mm; give longer or shorter cut-offs");
    const double scale = parameters.rms_slope / std::sqrt(slopes);
    return {scale * inverse_complex_transform(waves).real().reshaped().matrix(), grid.spacing(), shape.rows,
            grid.row_spacing()};
}

} // namespace rough
