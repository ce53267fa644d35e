#include "domain/problem/limits.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

using testing::two_mm;
const Grid grid{513, two_mm, false};

Genome one_wave(double lambda = two_mm / 4) { return {0.02, {{1, 0.8, 1.5, lambda, {{1, {0.4}}}}}}; }

/// Slope, height and radius of one cosine are a k, 2 a and 1/(a k^2).
struct Exact {
    double slope, height, radius;
};
Exact exact() {
    const Wave wave = waves(one_wave())[0];
    const double a = std::abs(wave.amplitude), k = wave.wave_number;
    return {a * k, 2 * a, 1 / (a * k * k)};
}

} // namespace

TEST_CASE("margins of one wave are those of a cosine, on the safe side") {
    const auto found = margins(one_wave(), grid, {});
    const Exact wave = exact();
    CHECK(found[0].value == Approx(two_mm / 4).epsilon(1e-9));
    CHECK(found[1].value == Approx(wave.slope).epsilon(1e-4));
    CHECK(found[2].value == Approx(wave.height).epsilon(1e-4));
    CHECK(found[3].value == Approx(wave.radius).epsilon(1e-4));
    CHECK(found[0].value >= two_mm / 4);
    CHECK(found[1].value >= wave.slope);
    CHECK(found[2].value >= wave.height);
    CHECK(found[3].value <= wave.radius);
}

TEST_CASE("the excess over limits on shape is the sum of the shares beyond them") {
    const Exact wave = exact();
    const auto within_bound = [](double expected) { return Approx(expected).margin(3e-4); };
    const MakingLimits slope{.max_slope = wave.slope / 1.25}, height{.max_height = wave.height / 1.5},
        radius{.min_radius = 1.1 * wave.radius}, all{0, slope.max_slope, height.max_height, radius.min_radius},
        kept{0, 1.01 * wave.slope, 1.01 * wave.height, 0.99 * wave.radius};
    CHECK(excess(one_wave(), grid, slope) == within_bound(0.25));
    CHECK(excess(one_wave(), grid, height) == within_bound(0.5));
    CHECK(excess(one_wave(), grid, radius) == within_bound(0.1));
    CHECK(excess(one_wave(), grid, all) == within_bound(0.85));
    CHECK(excess(one_wave(), grid, kept) == 0);
    CHECK(excess(one_wave(), grid, {}) == 0);
    Genome steep = one_wave(); // with a radius below a millimetre
    steep.scale *= 100;
    CHECK(excess(steep, grid, {.min_radius = 1.1 * wave.radius / 100}) == within_bound(0.1));
}
