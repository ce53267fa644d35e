#include "domain/profile/fractal.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/profile/detrend.hpp"
#include "ga/base/random.hpp"

#include <cmath>
#include <complex>

namespace rough {

namespace {

/// A real sequence and its transform, with the plan between them.
struct Transform {
    explicit Transform(Index length)
        : plan(fourier_plan({length})), bins(length / 2 + 1), real(length), spectrum(bins) {}
    void forward() { fftw_execute_dft_r2c(plan.forward, real.data(), spectrum.data()); }
    void backward() { fftw_execute_dft_c2r(plan.backward, spectrum.data(), real.data()); }

    FourierPlan plan;
    Index bins;
    AlignedBuffer<double> real;
    AlignedBuffer<fftw_complex> spectrum;
};

} // namespace

Profile fractal_profile(const Grid& grid, double hurst, double rms, std::uint64_t seed) {
    if (!(hurst > 0 && hurst < 1))
        throw InputError("hurst: " + std::to_string(hurst) + " given, expected a number between 0 and 1");
    if (!(rms > 0) || grid.nodes < 4)
        throw InputError("fractal profile: an rms height above 0 and 4 nodes or more are expected");
    Transform transform(4 * grid.nodes);
    ga::Stream random(ga::fold(seed, "fractal"));
    transform.spectrum[0][0] = transform.spectrum[0][1] = 0;
    for (Index bin = 1; bin < transform.bins; ++bin) {
        const double deviation = std::pow(static_cast<double>(bin), -(hurst + 0.5));
        transform.spectrum[bin][0] = deviation * random.normal();
        transform.spectrum[bin][1] = deviation * random.normal();
    }
    transform.backward();
    const Eigen::VectorXd heights =
        detrended({Eigen::Map<const Eigen::VectorXd>(transform.real.data(), grid.nodes), grid.spacing()},
                  Detrend::line);
    const double scale = rms / std::sqrt(heights.squaredNorm() / static_cast<double>(grid.nodes));
    return {scale * heights, grid.spacing()};
}

std::vector<Band> octave_bands(const Profile& profile) {
    const Index nodes = profile.nodes();
    Transform transform(2 * nodes);
    for (Index i = 0; i < nodes; ++i)
        transform.real[i] = transform.real[2 * nodes - 1 - i] = profile.heights[i];
    transform.forward();
    std::vector<std::complex<double>> whole;
    for (Index bin = 0; bin < transform.bins; ++bin)
        whole.emplace_back(transform.spectrum[bin][0], transform.spectrum[bin][1]);

    const double period = 2 * static_cast<double>(nodes) * profile.spacing;
    std::vector<Band> bands;
    for (Index first = 1; first < nodes; first *= 2) { // bin N, the last, is empty
        const Index past = std::min(2 * first, transform.bins);
        for (Index bin = 0; bin < transform.bins; ++bin) {
            const auto value =
                bin >= first && bin < past ? whole[static_cast<std::size_t>(bin)] : std::complex<double>();
            transform.spectrum[bin][0] = value.real();
            transform.spectrum[bin][1] = value.imag();
        }
        transform.backward();
        bands.push_back({period / static_cast<double>(first), period / static_cast<double>(2 * first),
                         Eigen::Map<const Eigen::VectorXd>(transform.real.data(), nodes) /
                             static_cast<double>(2 * nodes)});
    }
    return bands;
}

} // namespace rough
