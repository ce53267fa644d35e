#include "domain/mwm/genome.hpp"
#include "domain/mwm/sampling.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using testing::random_genome;

namespace {

std::size_t chromosomes(const Genome& genome) {
    std::size_t count = 0;
    for (const auto& series : genome.series)
        count += series.chromosomes.size();
    return count;
}

} // namespace

TEST_CASE("two children of a cross-over of length scales add up to their parents") {
    std::mt19937_64 random(31);
    const Grid grid{64, 0.84942, false};
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Genome a = random_genome(random, 1 + seed % 2, 1 + seed % 3, 0.84942, 0.03),
               b = random_genome(random, 2, 1, 0.84942, 0.05);
        a.scale = 0.01;
        const Genome left = a, right = b;
        ga::Stream stream(seed);
        if (seed % 3 == 0)
            cross_uniform(a, b, stream);
        else
            cross_points(a, b, seed % 3, stream);
        CHECK_NOTHROW(validate(a, "child"));
        CHECK_NOTHROW(validate(b, "child"));
        CHECK(chromosomes(a) == chromosomes(left));
        CHECK(chromosomes(b) == chromosomes(right));
        const Eigen::VectorXd before = sample(left, grid).heights + sample(right, grid).heights;
        CHECK((sample(a, grid).heights + sample(b, grid).heights - before).norm() < 1e-12 * before.norm());
    }
}

TEST_CASE("a one-point cross-over exchanges only the short waves") {
    std::mt19937_64 random(33);
    Genome a = random_genome(random, 1, 1, 0.84942, 0.03), b = random_genome(random, 1, 1, 0.84942, 0.03);
    const auto longest = a.series[0].chromosomes[0].phases;
    const auto shortest = b.series[0].chromosomes.back().phases;
    ga::Stream stream(5);
    cross_points(a, b, 1, stream);
    CHECK(a.series[0].chromosomes[0].phases == longest);
    REQUIRE(a.series.size() == 2);
    if (chromosomes(a) >= chromosomes(b))
        CHECK(a.series[1].chromosomes.back().phases == shortest);
}
