#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"
#include "tests/catch.hpp"

#include <numbers>

using namespace rough;

namespace {

const Grid grid{512, 0.8, false};

/// Mean power of one octave band over many profiles.
double band_power(double hurst, std::size_t band) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        sum += octave_bands(fractal_profile(grid, hurst, 1, seed))[band].heights.squaredNorm();
    return sum;
}

} // namespace

TEST_CASE("only a periodic self-affine profile repeats without a jump") {
    for (const bool periodic : {true, false}) {
        const auto waves = self_affine_waves(0.7, 0.05, 0.8, 1.5, 8, periodic);
        CHECK((std::abs(height_at(waves, 0.13) - height_at(waves, 0.83)) < 1e-12) == periodic);
    }
}

TEST_CASE("amplitudes fall with the wavenumber by the Hurst exponent") {
    const auto slope_of = [](const std::vector<Wave>& waves) {
        Eigen::VectorXd number(static_cast<Index>(waves.size())), amplitude(number.size());
        for (Index i = 0; i < number.size(); ++i) {
            const Wave& wave = waves[static_cast<std::size_t>(i)];
            number[i] = std::log(wave.wave_number);
            amplitude[i] = std::log(std::abs(wave.amplitude));
        }
        return slope(number, amplitude);
    };
    CHECK(slope_of(self_affine_waves(0.7, 0.05, 0.8, 1.5, 8)) == Approx(-0.8));
    const auto brownian = brownian_waves(0.7, 0.05, 0.8, 64);
    CHECK(slope_of(brownian) == Approx(-1.3));
    CHECK(brownian.size() == 64);
    CHECK(brownian.front().amplitude == -0.05);
    CHECK(brownian.front().wave_number == Approx(2 * std::numbers::pi / 0.7));
}

TEST_CASE("a fractal profile's power falls by 2^(-2H) per octave of wavenumber") {
    for (double hurst : {0.3, 0.5, 0.8})
        CHECK(std::log2(band_power(hurst, 2) / band_power(hurst, 6)) / 4 == Approx(2 * hurst).margin(0.1));
}

TEST_CASE("a fractal profile has the requested rms height, no tilt, and bits set by its seed") {
    const Profile profile = fractal_profile(grid, 0.7, 2e-3, 5);
    REQUIRE(profile.nodes() == 512);
    CHECK(profile.spacing == grid.spacing());
    CHECK(std::sqrt(profile.heights.squaredNorm() / 512) == Approx(2e-3));
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(512, -1, 1);
    CHECK(std::abs(x.dot(profile.heights)) < 1e-12);
    CHECK(profile.heights == fractal_profile(grid, 0.7, 2e-3, 5).heights);
    CHECK(profile.heights != fractal_profile(grid, 0.7, 2e-3, 6).heights);
}

TEST_CASE("octave bands add up to the profile, and a cosine is in one of them") {
    for (Index nodes : {4, 7, 512, 500}) {
        const Profile profile = fractal_profile({nodes, 0.8, false}, 0.6, 1, 3);
        Eigen::VectorXd sum = Eigen::VectorXd::Constant(nodes, profile.heights.mean());
        for (const Band& band : octave_bands(profile)) {
            sum += band.heights;
            CHECK(band.heights.cwiseAbs().maxCoeff() > 0);
            CHECK(band.longest == Approx(2 * band.shortest));
        }
        CHECK((sum - profile.heights).cwiseAbs().maxCoeff() < 1e-13);
    }
    // half-sample symmetric, so one component of the even continuation
    const Profile cosine = sampled({256, 1, true}, [](double x) { return std::cos(M_PI * 12 * (x + 0.5 / 256)); });
    for (const Band& band : octave_bands(cosine)) {
        const double wave_length = 2.0 / 12;
        const bool holds = wave_length <= band.longest && wave_length > band.shortest;
        CHECK(band.heights.norm() == Approx(holds ? cosine.heights.norm() : 0).margin(1e-12));
    }
}
