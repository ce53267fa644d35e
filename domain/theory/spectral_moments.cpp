#include "domain/theory/spectral_moments.hpp"

#include "domain/errors.hpp"

#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// int q^n C dq over the spectrum, whatever the waves' direction.
double moment(const Spectrum& spectrum, int n) {
    return (spectrum.wave_number.array().pow(n) * spectrum.power.array()).sum();
}

/// int_from^to q^exponent dq
double power_integral(double exponent, double from, double to) {
    const double n = exponent + 1;
    return std::abs(n) < 1e-12 ? std::log(to / from) : (std::pow(to, n) - std::pow(from, n)) / n;
}

} // namespace

RandomSurface random_surface(const Profile& surface, bool wraps) {
    RandomSurface random{continuous_spectrum(surface, wraps), surface.is_2d()};
    if (!(random.spectrum.power.sum() > 0))
        refuse("theory: a flat surface, expected a rough one");
    return random;
}

RandomSurface random_surface(const SelfAffine& of) {
    if (!(of.hurst > 0 && of.hurst < 1))
        refuse("hurst: ", of.hurst, " given, expected a number between 0 and 1");
    if (!(of.shortest > 0 && of.longest > of.shortest && std::isfinite(of.longest)))
        refuse("cut-offs: ", of.longest, " and ", of.shortest,
               " mm given, expected the longer one first, both above 0");
    if (!(of.rms_slope > 0) || !std::isfinite(of.rms_slope) || of.wave_numbers < 1)
        refuse("rms slope: ", of.rms_slope, " given, expected a number above 0");
    RandomSurface random{{Eigen::VectorXd(of.wave_numbers), {}, Eigen::VectorXd(of.wave_numbers)},
                         of.is_area};
    const double least = 2 * std::numbers::pi / of.longest,
                 step = std::log(of.longest / of.shortest) / static_cast<double>(of.wave_numbers);
    for (Index k = 0; k < of.wave_numbers; ++k) {
        const double from = least * std::exp(step * static_cast<double>(k)), to = from * std::exp(step);
        // Around the circle an area's q^-2(1 + H) is a profile's q^-(1 + 2 H).
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

} // namespace rough
