#include "domain/mwm/sampling.hpp"
#include "domain/profile/roughness.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

constexpr double pi = std::numbers::pi;

Profile cosine(double amplitude, int waves, double length, Index nodes) {
    Profile profile{Eigen::VectorXd(nodes), length / double(nodes)};
    for (Index i = 0; i < nodes; ++i)
        profile.heights[i] = 7 + amplitude * std::cos(2 * pi * waves * double(i) / double(nodes));
    return profile;
}

} // namespace

TEST_CASE("a cosine has the roughness of textbooks") {
    const double a = 0.003, length = 2;
    const int waves = 10;
    const Roughness r = roughness(cosine(a, waves, length, 4000));
    const double k = 2 * pi * waves / length;
    CHECK(r.Ra == Approx(2 * a / pi).epsilon(1e-4));
    CHECK(r.Rq == Approx(a / std::sqrt(2)).epsilon(1e-12));
    CHECK(r.Rsk == Approx(0).margin(1e-12));
    CHECK(r.Rku == Approx(1.5).epsilon(1e-12));
    CHECK(r.Rz == Approx(2 * a).epsilon(1e-12));
    CHECK(r.Rt == Approx(2 * a).epsilon(1e-12));
    CHECK(r.Rdq == Approx(a * k / std::sqrt(2)).epsilon(1e-3));
    CHECK(r.rms_curvature == Approx(a * k * k / std::sqrt(2)).epsilon(1e-3));
    CHECK(r.m0 == Approx(a * a / 2));
    CHECK(r.bandwidth == Approx(1).epsilon(1e-2)); // three nodes at either end have no derivative
}

TEST_CASE("Rz is the mean of five sections' heights and Rt the height of the whole") {
    Profile profile{Eigen::VectorXd::Zero(50), 0.1};
    for (Index s = 0; s < 5; ++s) {
        profile.heights[10 * s + 3] = double(s + 1);
        profile.heights[10 * s + 7] = -0.5;
    }
    const Roughness r = roughness(profile);
    CHECK(r.Rz == Approx(3.5));
    CHECK(r.Rt == Approx(5.5));
    CHECK(r.Rsk > 0);
}

TEST_CASE("spectral moments of a finely sampled profile are those of its cosines") {
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 5; ++trial) {
        // whole numbers of waves on the length, so that means over it are exact
        Genome genome;
        genome.series.push_back({0.7, 0.8, 2, 1, {}});
        for (int n = 1; n <= 5; ++n)
            genome.series[0].chromosomes.push_back({n, {testing::uniform(random, 0, 6.28)}});
        const Roughness r = roughness(sample(genome, {.nodes = 8192, .length = 1, .wraps = true}));
        double m0 = 0, m2 = 0, m4 = 0;
        for (const Wave& wave : waves(genome)) {
            const double power = wave.amplitude * wave.amplitude / 2, k = wave.wave_number;
            m0 += power, m2 += power * k * k, m4 += power * k * k * k * k;
        }
        CHECK(r.m0 == Approx(m0).epsilon(1e-9));
        CHECK(r.m2 == Approx(m2).epsilon(5e-3));
        CHECK(r.m4 == Approx(m4).epsilon(5e-3));
    }
}

TEST_CASE("roughness does not change when a profile is lifted, and scales with its heights") {
    std::mt19937_64 random(5);
    const Profile profile = sample(testing::random_genome(random, 2, 3, 1, 0.05), {});
    Profile other = profile;
    other.heights = 3 * profile.heights.array() - 20;
    const Roughness one = roughness(profile), three = roughness(other);
    CHECK(three.Ra == Approx(3 * one.Ra));
    CHECK(three.Rz == Approx(3 * one.Rz));
    CHECK(three.Rdq == Approx(3 * one.Rdq));
    CHECK(three.Rsk == Approx(one.Rsk).margin(1e-9));
    CHECK(three.Rku == Approx(one.Rku));
    CHECK(three.bandwidth == Approx(one.bandwidth));
}

TEST_CASE("a constant or too short profile has no roughness") {
    CHECK_THROWS_WITH(roughness({Eigen::VectorXd::Constant(50, 2), 0.1}), Catch::Contains("constant"));
    CHECK_THROWS_WITH(roughness({Eigen::VectorXd::Random(9), 0.1}), Catch::Contains("9 nodes"));
}
