#include "domain/mwm/sampling.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace rough;
using testing::random_genome;

namespace {

constexpr double pi = std::numbers::pi;

Grid area(Index columns, Index rows, bool periodic) {
    Grid grid{columns, 0.84942, periodic};
    grid.rows = rows;
    grid.width = 0.7;
    return grid;
}

} // namespace

TEST_CASE("on an area every ridge is a plane wave in its own direction", "[areas]") {
    Genome genome;
    genome.scale = 0.4;
    genome.series = {Series{.A = 1e-3,
                            .H = 0.7,
                            .gamma = 1.6,
                            .lambda = 0.5,
                            .chromosomes = {{1, {0.3, 1.1, 2.5}}, {3, {4, 5}}}}};
    const Grid grid = area(31, 23, false);
    const Profile map = sample(genome, grid);
    for (const Index node : {0, 17, 200, 431, 712}) {
        const double x = grid.spacing() * static_cast<double>(node % 31),
                     y = grid.row_spacing() * static_cast<double>(node / 31);
        double height = 0; // as printed
        for (const Chromosome& chromosome : genome.series[0].chromosomes) {
            const double M = static_cast<double>(chromosome.phases.size()),
                         k = 2 * pi / 0.5 * std::pow(1.6, chromosome.n - 1);
            for (std::size_t m = 0; m < chromosome.phases.size(); ++m) {
                const double theta = pi * static_cast<double>(m) / M, phi = chromosome.phases[m];
                height += 0.4 * 1e-3 * std::sqrt(std::log10(1.6) / M) * std::pow(k, -0.7) *
                          (std::cos(phi) - std::cos(k * (x * std::cos(theta) + y * std::sin(theta)) + phi));
            }
        }
        CHECK(map.heights[node] == Approx(height).epsilon(1e-10).margin(1e-15));
    }
}

TEST_CASE("on a periodic map wave vectors are the lattice's nearest, and never zero", "[areas]") {
    std::mt19937_64 random(22);
    const Genome genome = random_genome(random, 2, 5, 0.84942, 0.02);
    const auto moved = plane_waves(genome, area(64, 48, true)),
               free = plane_waves(genome, area(64, 48, false));
    for (std::size_t w = 0; w < moved.size(); ++w) {
        const double i = moved[w].k_x * 0.84942 / (2 * pi), j = moved[w].k_y * 0.7 / (2 * pi);
        CHECK(std::abs(i - std::round(i)) < 1e-9);
        CHECK(std::abs(j - std::round(j)) < 1e-9);
        CHECK(std::hypot(i, j) > 0.5);
        CHECK(std::abs(moved[w].k_x - free[w].k_x) <= (1 + 1e-12) * pi / 0.84942);
        CHECK(std::abs(moved[w].k_y - free[w].k_y) <= (1 + 1e-12) * pi / 0.7);
        const double far = std::hypot(moved[w].k_x - free[w].k_x, moved[w].k_y - free[w].k_y);
        CHECK(moved[w].moved == Approx(far / std::hypot(free[w].k_x, free[w].k_y)).margin(1e-12));
        CHECK(free[w].moved == 0);
    }
    Genome slow;
    slow.series = {Series{.A = 1, .H = 1, .gamma = 1.5, .lambda = 9, .chromosomes = {{1, {0.4}}}}};
    CHECK(plane_waves(slow, area(64, 48, true))[0].k_x == Approx(2 * pi / 0.84942));
}
