#include "domain/theory/theory.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/expint.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace rough {

namespace {

constexpr double correction = 0.45; ///< gamma

/// int_s^inf erf^2(t) exp(-t^2)/t dt, by cubic interpolation of tabulated values and slopes.
double reached_part(double s) {
    constexpr int intervals = 256;
    constexpr double last = 6, step = last / intervals; // beyond it the integral is below 1e-17
    const auto integrand = [](double t) {
        const double error = std::erf(t);
        return t > 0 ? error * error * std::exp(-t * t) / t : 0;
    };
    static const std::array<double, intervals + 1> table = [&] {
        std::array<double, intervals + 1> sums{};
        for (int i = intervals; i-- > 0;)
            sums[static_cast<std::size_t>(i)] =
                sums[static_cast<std::size_t>(i + 1)] +
                boost::math::quadrature::gauss<double, 7>::integrate(integrand, i * step, (i + 1) * step);
        return sums;
    }();
    if (!(s < last))
        return 0;
    const auto i = static_cast<std::size_t>(s / step);
    const double from = static_cast<double>(i) * step, t = (s - from) / step;
    const double slope = -step * integrand(from), next_slope = -step * integrand(from + step);
    const double rise = table[i + 1] - table[i];
    return table[i] +
           t * (slope + t * (3 * rise - 2 * slope - next_slope + t * (slope + next_slope - 2 * rise)));
}

/// 1/sqrt(2 pi) int f(h'(q)) q/h'(q) dm0, in which q^2 dm0 = 2 h' dh'.
template <class Function>
double over_waves(const Spectrum& spectrum, Function f) {
    double sum = 0, square = 0;
    for (Index k = 0; k < spectrum.power.size(); ++k) {
        const double q = spectrum.wave_number[k], before = std::sqrt(square);
        square += q * q * spectrum.power[k];
        if (square > before * before)
            sum += 2 / q * boost::math::quadrature::gauss<double, 7>::integrate(f, before, std::sqrt(square));
    }
    return sum / std::sqrt(2 * std::numbers::pi);
}

} // namespace

TheoryCurve persson(const RandomSurface& surface, double effective_modulus,
                    const Eigen::VectorXd& pressures) {
    TheoryCurve curve{pressures, Eigen::VectorXd(pressures.size()), Eigen::VectorXd(pressures.size()),
                      Eigen::VectorXd(pressures.size())};
    const double slope = rms_slope(surface);
    for (Index j = 0; j < pressures.size(); ++j) {
        const double load = std::numbers::sqrt2 * pressures[j] / effective_modulus;
        curve.contact_fraction[j] = std::erf(load / slope);
        curve.stiffness[j] =
            pressures[j] / over_waves(surface.spectrum, [&](double h) {
                const double s = load / h, error = std::erf(s);
                return (correction + 3 * (1 - correction) * error * error) * std::exp(-s * s);
            });
        curve.separation[j] = over_waves(surface.spectrum, [&](double h) { // 1/K integrated from P on
            const double s = load / h;
            return s > 26 ? 0
                          : correction / 2 * boost::math::expint(1, s * s) +
                                3 * (1 - correction) * reached_part(s);
        });
    }
    return curve;
}

double persson_length(const RandomSurface& surface) {
    return over_waves(surface.spectrum, [](double) { return correction; });
}

} // namespace rough
