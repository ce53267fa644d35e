#include "domain/spectrum.hpp"

#include "domain/contact/fourier.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

namespace rough {

std::vector<SpectralLine> discrete_spectrum(const Genome& genome) {
    std::vector<Wave> all = waves(genome);
    std::sort(all.begin(), all.end(),
              [](const Wave& a, const Wave& b) { return a.wave_number < b.wave_number; });
    std::vector<SpectralLine> lines;
    for (auto wave = all.begin(); wave != all.end();) {
        const double k = wave->wave_number;
        std::complex<double> sum = 0;
        for (; wave != all.end() && wave->wave_number <= k * (1 + 1e-12); ++wave)
            sum += std::polar(1.0, wave->phase) * wave->amplitude;
        lines.push_back({k, std::norm(sum) / 2});
    }
    return lines;
}

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
