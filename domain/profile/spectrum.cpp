#include "domain/profile/spectrum.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace rough {

Spectrum continuous_spectrum(const Profile& profile) {
    const Index n = profile.nodes(), half = n / 2;
    if (n < 4)
        throw InputError("spectrum: a profile of " + std::to_string(n) + " nodes, expected at least 4");
    const double mean = profile.heights.mean(), turn = 2 * std::numbers::pi / static_cast<double>(n);
    AlignedBuffer<double> windowed(n);
    AlignedBuffer<fftw_complex> transform(half + 1);
    double window_square = 0;
    for (Index i = 0; i < n; ++i) {
        const double window = 0.5 - 0.5 * std::cos(turn * static_cast<double>(i));
        windowed[i] = window * (profile.heights[i] - mean);
        window_square += window * window;
    }
    fftw_execute_dft_r2c(fourier_plan(n).forward, windowed.data(), transform.data());

    Spectrum spectrum{Eigen::VectorXd(half), Eigen::VectorXd(half)};
    const double scale = profile.spacing / (2 * std::numbers::pi * window_square);
    for (Index k = 1; k <= half; ++k) {
        const double power = transform[k][0] * transform[k][0] + transform[k][1] * transform[k][1];
        spectrum.wave_number[k - 1] = turn * static_cast<double>(k) / profile.spacing;
        spectrum.density[k - 1] = (2 * k == n ? 1 : 2) * scale * power;
    }
    return spectrum;
}

} // namespace rough
