#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"
#include "ga/base/random.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace rough;

TEST_CASE("a periodic self-affine profile repeats, and another has its jump") {
    for (const bool periodic : {true, false}) {
        const auto waves = self_affine_waves(0.7, 0.05, 0.8, 1.5, 8, periodic);
        CHECK((std::abs(height_at(waves, 0.13) - height_at(waves, 0.83)) < 1e-12) == periodic);
    }
}

TEST_CASE("amplitudes fall with the wave number as the Hurst exponent says") {
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
