#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace ga;

namespace {

/// Minus the square of a gene with noise of deviation 1, another draw for each replicate.
struct Noise {
    using Genome = std::vector<double>;
    using Outcome = double;

    double evaluate(const Genome& x) const { return evaluate(x, 0); }
    double evaluate(const Genome& x, std::uint64_t replicate) const {
        Stream stream(fold(fold(7, fingerprint(x).low), replicate));
        return truth(x) + stream.normal();
    }
    static double truth(const Genome& x) { return -x[0] * x[0]; }
    const std::vector<Objective<double>>& objectives() const {
        static const std::vector<Objective<double>> list = {{"value", [](const double& v) { return v; }}};
        return list;
    }
    std::vector<Variable> bounds(const Genome&) const { return {{0, -3, 3}}; }
    Genome sample(Stream& stream) const { return {stream.uniform(-3, 3)}; }
};

/// By how much the best is said to be better than it is.
double flattery(const Stage<Noise>& pipeline, std::uint64_t seed) {
    const auto result = run(pipeline, Noise{}, {}, {.seed = seed});
    return result.best->value() - Noise::truth(result.best->genome);
}

Stage<Noise> search(const Stage<Noise>& scored) {
    return sample(20) | scored | repeat(20, tournament(2) | cross(blend()) | mutate(0.5) | scored | elite(2));
}

} // namespace

TEST_CASE("means of replicates flatter the best far less than single draws of a noisy fitness") {
    double single = 0, mean = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        single += flattery(search(score()), seed) / 10;
        mean += flattery(search(average(25)), seed) / 10;
    }
    CHECK(single > 1.5);
    CHECK(mean < 0.8);
    CHECK(mean > -0.2);
}

TEST_CASE("replicates that are known are not paid again, and a mean is that of its draws") {
    const Noise problem;
    const Noise::Genome genome{1.5};
    const auto result = run(score() | average(4) | average(10), problem, population<Noise::Genome>({genome}));
    CHECK(result.counters.evaluations == 10);
    double mean = 0;
    for (std::uint64_t replicate = 0; replicate < 10; ++replicate)
        mean += problem.evaluate(genome, replicate) / 10;
    CHECK(result.population[0].value() == Approx(mean));
    const auto bits = [&](int threads) {
        return run(search(average(5)), problem, {}, {.seed = 3, .threads = threads}).best->genome;
    };
    CHECK(bits(1) == bits(3));
}
