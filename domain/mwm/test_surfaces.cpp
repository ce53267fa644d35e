#include "domain/mwm/test_surfaces.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/profile/preparation.hpp"

#include <numbers>

namespace rough {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

constexpr double golden_angle = 2.399963; // its multiples fill the turn evenly and never repeat

} // namespace

std::vector<Wave> self_affine_waves(double length, double amplitude, double hurst, double ratio, int count,
                                    bool periodic) {
    std::vector<Wave> waves;
    for (int n = 0; n < count; ++n) {
        const double number = std::pow(ratio, n);
        waves.push_back({-amplitude * std::pow(ratio, -n * hurst),
                         full_turn * (periodic ? std::floor(number) : number) / length, golden_angle * n, 0});
    }
    return waves;
}

std::vector<Wave> brownian_waves(double length, double amplitude, double hurst, int count) {
    std::vector<Wave> waves;
    for (int n = 1; n <= count; ++n)
        waves.push_back({-amplitude * std::pow(n, -(hurst + 0.5)), full_turn * n / length,
                         golden_angle * (n - 1) * (n - 1), 0}); // if they grew evenly, crests would meet
    return waves;
}

double height_at(const std::vector<Wave>& waves, double x) {
    double height = 0;
    for (const Wave& wave : waves) height -= wave.amplitude * std::cos(wave.wave_number * x + wave.phase);
    return height;
}

Profile sampled(const Grid& grid, const std::function<double(double)>& height) {
    Profile profile{Eigen::VectorXd(grid.nodes), grid.spacing()};
    for (Index i = 0; i < grid.nodes; ++i) profile.heights[i] = height(static_cast<double>(i) * profile.spacing);
    return profile;
}

Profile fractal_profile(const Grid& grid, double hurst, double rms, std::uint64_t seed) {
    if (!(hurst > 0 && hurst < 1)) refuse("hurst: ", hurst, " is out of range (above 0, below 1)");
    if (!(rms > 0) || grid.nodes < 4)
        refuse("fractal profile: rms height ", rms, " on ", grid.nodes, " nodes; use one above 0 on 4 or more");
    ga::Stream random(ga::fold(seed, "fractal"));
    Eigen::ArrayXcd spectrum = Eigen::ArrayXcd::Zero(2 * grid.nodes + 1);
    for (Index bin = 1; bin < spectrum.size(); ++bin) {
        const double deviation = std::pow(static_cast<double>(bin), -(hurst + 0.5));
        spectrum[bin].real(deviation * random.normal());
        spectrum[bin].imag(deviation * random.normal());
    }
    const Eigen::ArrayXd whole = inverse_fourier_transform(spectrum, 4 * grid.nodes);
    const Eigen::VectorXd heights = detrended({whole.head(grid.nodes), grid.spacing()}, Detrend::line);
    const double scale = rms / std::sqrt(heights.squaredNorm() / static_cast<double>(grid.nodes));
    return {scale * heights, grid.spacing()};
}

std::vector<Band> octave_bands(const Profile& profile) {
    const Index nodes = profile.nodes();
    Eigen::ArrayXd mirrored(2 * nodes);
    mirrored << profile.heights.array(), profile.heights.array().reverse();
    const Eigen::ArrayXcd whole = fourier_transform(mirrored);
    const double period = 2 * static_cast<double>(nodes) * profile.spacing;
    std::vector<Band> bands;
    for (Index first = 1; first < nodes; first *= 2) { // bin N, the last, is empty
        const Index count = std::min(first, whole.size() - first);
        Eigen::ArrayXcd band = Eigen::ArrayXcd::Zero(whole.size());
        band.segment(first, count) = whole.segment(first, count);
        const Eigen::ArrayXd heights = inverse_fourier_transform(band, 2 * nodes);
        bands.push_back({period / static_cast<double>(first), period / static_cast<double>(2 * first),
                         heights.head(nodes) / static_cast<double>(2 * nodes)});
    }
    return bands;
}

} // namespace rough
