#include "ga/ga.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

/// Genome x has noise of deviation 1 about minus its square; replicate 0 of x = 1 is a lucky draw of +5.
struct Lucky {
    using Genome = std::vector<double>;
    using Outcome = double;

    double evaluate(const Genome& x) const { return evaluate(x, 0); }
    double evaluate(const Genome& x, std::uint64_t replicate) const {
        Stream stream(fold(fold(7, fingerprint(x).low), replicate));
        return -x[0] * x[0] + (replicate == 0 && x[0] == 1 ? 5 : stream.normal());
    }
    const std::vector<Objective<double>>& objectives() const {
        static const std::vector<Objective<double>> list = {{"value", [](const double& v) { return v; }}};
        return list;
    }
    std::vector<Variable> bounds(const Genome&) const { return {{0, -3, 3}}; }
    Genome sample(Stream& stream) const { return {stream.uniform(-3, 3)}; }
};

Population<Lucky::Genome> start() { return population<Lucky::Genome>({{1}, {0}, {2}, {-1.5}}); }

} // namespace

TEST_CASE("an individual met again gets more replicates, up to the limit, and is paid for them only") {
    const auto result = run<Lucky>(average(2) | repeat(10, average(2, "", 9)), Lucky{}, start());
    CHECK(result.counters.evaluations == 4 * 9);
    CHECK(result.counters.asked == 4 * 9);
    for (const auto& each : result.population) {
        double mean = 0;
        for (std::uint64_t replicate = 0; replicate < 9; ++replicate)
            mean += Lucky{}.evaluate(each.genome, replicate) / 9;
        CHECK(each.fitness.replicates() == 9);
        CHECK(each.value() == Approx(mean));
    }
}

TEST_CASE("the best of a run does not stay the best by lucky draws") {
    CHECK(run<Lucky>(score(), Lucky{}, start()).best->genome[0] == 1); // 4, and -1 in the mean
    const auto result = run<Lucky>(score() | repeat(30, average(5, "", 100) | elite(1)), Lucky{}, start());
    CHECK(result.best->genome[0] == 0);
    CHECK(std::abs(result.best->value()) < 0.5);
    CHECK(best_of(result.population, 1)[0].genome[0] == 0);
}

TEST_CASE("an elite that is averaged again flatters less than one that keeps its first mean") {
    double once = 0, again = 0;
    const auto flattery = [](const Stage<Lucky>& scored, std::uint64_t seed) {
        const auto result = run<Lucky>(
            sample(20) | scored |
                repeat(20, tournament(2) | cross(blend()) | mutate(0.5) | scored | elite(2) | scored),
            Lucky{}, {}, {.seed = seed});
        return result.best->value() + result.best->genome[0] * result.best->genome[0];
    };
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        once += flattery(average(5), seed) / 10;
        again += flattery(average(5, "", 200), seed) / 10;
    }
    CHECK(again < 0.7 * once);
}
