// A genetic algorithm on bit strings: one-max, and a trap that punishes climbing.

#include "ga/ga.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

/// Strings of n bits. The fitness is a sum over blocks of k bits. A full block gives k, another block k - 1 -
/// ones. For k = 1 the sum is the number of ones.
struct Traps {
    using Genome = std::vector<bool>;
    using Outcome = int;

    std::size_t n, k;

    Outcome evaluate(const Genome& bits) const {
        int sum = 0;
        for (std::size_t block = 0; block < n; block += k) {
            int ones = 0;
            for (std::size_t i = 0; i < k; ++i)
                ones += bits[block + i];
            sum += ones == static_cast<int>(k) ? ones : k == 1 ? 0 : static_cast<int>(k) - 1 - ones;
        }
        return sum;
    }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {
            {"ones", [](const int& sum) { return double(sum); }}};
        return list;
    }
    Genome sample(Stream& stream) const {
        Genome bits(n);
        for (std::size_t i = 0; i < n; ++i)
            bits[i] = stream.chance(0.5);
        return bits;
    }
};

const auto nobody = population<std::vector<bool>>({{}});

} // namespace

TEST_CASE("a genetic algorithm fills a string of 100 ones") {
    const auto pipeline = sample(60) | score() |
                          until({.generations = 500, .fitness = 100},
                                tournament(3) | cross(uniform()) | mutate(0.01) | score() | elite(1));
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto result = run(pipeline, Traps{100, 1}, nobody, {.seed = seed});
        CHECK(result.best->value() == 100);
        CHECK(result.best->genome == std::vector<bool>(100, true));
    }
}

TEST_CASE("two-point cross-over solves traps of four bits, unlike mutation alone") {
    const Traps traps{32, 4};
    const auto crossing =
        sample(400) | score() |
        until({.generations = 60, .fitness = 32}, tournament(4) | cross(n_points(2)) | score() | elite(1));
    const auto climbing =
        sample(400) | score() |
        until({.generations = 60, .fitness = 32}, tournament(4) | mutate(0.02) | score() | elite(1));
    int solved = 0, climbed = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        solved += run(crossing, traps, nobody, {.seed = seed}).best->value() == 32;
        climbed += run(climbing, traps, nobody, {.seed = seed}).best->value() == 32;
    }
    CHECK(solved >= 4);
    CHECK(solved > climbed);
}
