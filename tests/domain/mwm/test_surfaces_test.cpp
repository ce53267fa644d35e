#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"
#include "ga/base/random.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace rough;

TEST_CASE("a random genome keeps to its law, and genes without freedom are not drawn") {
    int draws = 0;
    ga::Stream random(3);
    const Uniform uniform = [&](double from, double to) {
        CHECK(from < to);
        ++draws;
        return random.uniform(from, to);
    };
    const Genome genome =
        random_genome(uniform, 2, 3, 1, 0.1, {.A_from = 1, .A_to = 1, .H_from = 0.8, .H_to = 0.8});
    REQUIRE(genome.series.size() == 2);
    std::size_t phases = 0;
    for (const Series& series : genome.series) {
        CHECK(series.A == 1);
        CHECK(series.H == 0.8);
        CHECK(series.gamma >= 1.4);
        CHECK(series.gamma < 2);
        CHECK(wave_length(series, series.chromosomes.back().n) >= 0.1);
        CHECK(wave_length(series, series.chromosomes.back().n + 1) < 0.1);
        for (const Chromosome& chromosome : series.chromosomes)
            phases += chromosome.phases.size();
    }
    CHECK(draws == static_cast<int>(phases) + 2);
    CHECK_NOTHROW(validate(genome, "drawn"));
}

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

TEST_CASE("a formula is sampled at the grid's nodes") {
    const auto waves = self_affine_waves(0.7, 0.05, 0.8, 1.5, 1);
    const Profile profile =
        sampled({.nodes = 8, .length = 0.7, .wraps = true}, [&](double x) { return height_at(waves, x); });
    for (Index i = 0; i < 8; ++i)
        CHECK(profile.heights[i] ==
              Approx(0.05 * std::cos(std::numbers::pi * static_cast<double>(i) / 4)).margin(1e-15));
    CHECK(profile.spacing == Approx(0.7 / 8));
}
