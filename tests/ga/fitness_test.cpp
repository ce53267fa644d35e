#include "ga/observers/front.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <array>

using namespace ga;

namespace {

const Population<std::vector<double>> nobody;

/// Schaffer's problem (1985): x^2 and (x - 2)^2 are to be small; `cost` is the first, and is said to be
/// minimised.
struct Schaffer {
    using Genome = std::vector<double>;
    using Outcome = std::array<double, 2>;

    Outcome evaluate(const Genome& x) const { return {x[0] * x[0], (x[0] - 2) * (x[0] - 2)}; }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {
            {"f1", [](const Outcome& f) { return f[0]; }, true},
            {"f2", [](const Outcome& f) { return f[1]; }, true},
            {"worth", [](const Outcome& f) { return -f[0] - f[1]; }}};
        return list;
    }
    std::vector<Variable> bounds(const Genome&) const { return {{0, -10, 10}}; }
    Genome sample(Stream& stream) const { return {stream.uniform(-10, 10)}; }
};

/// The same where x is to be 1 at least.
struct Walled : Schaffer {
    using Genome = Schaffer::Genome;
    using Outcome = Schaffer::Outcome;
    double violation(const Outcome& f) const { return f[0] < 1 ? 1 - f[0] : 0; }
};

Fitness fitness(double value, bool minimise = false, double violation = 0, const char* name = "f") {
    return Fitness(Name(std::string(name)), value, minimise, violation);
}

} // namespace

TEST_CASE("less is better where the objective says so, and a fitness reads as its objective states it") {
    CHECK(better(fitness(1, true), fitness(2, true)));
    CHECK(!better(fitness(1, false), fitness(2, false)));
    CHECK(fitness(3, true).value() == 3);
    const auto result = run(sample(30) | score("f1") | best(3), Schaffer{}, nobody);
    CHECK(result.population[0].value() <= result.population[1].value());
    CHECK(result.best->value() == result.population[0].value());
    const auto elites = run(sample(20) | score() | repeat(30, tournament(2) | mutate(1) | score() | elite(1)),
                            Schaffer{}, nobody);
    CHECK(elites.best->value() < 1e-2);
    CHECK(run(sample(30) | score("f1") | below(1, at_least(1)), Schaffer{}, nobody).population[0].value() <
          1);
}

TEST_CASE("of two that violate constraints the one that does it less is better, and any that holds them "
          "betters both") {
    CHECK(better(fitness(1), fitness(9, false, 0.1)));
    CHECK(better(fitness(1, false, 0.1), fitness(9, false, 0.2)));
    CHECK(!better(fitness(1, false, 0.2), fitness(9, false, 0.2)));
    CHECK(better(fitness(9, false, 0.2), Fitness::failed(Name(std::string("f")), reason("no"))));
    const auto result = run(sample(40) | score() |
                                repeat(40, tournament(2) | cross(blend()) | mutate(0.5) | score() | plus()),
                            Walled{}, nobody);
    CHECK(result.best->fitness.feasible());
    CHECK(result.best->value() == Approx(1).margin(0.01));
    const auto shown = run(sample(40) | pareto({"f1", "f2"}) | ga::front(), Walled{}, nobody);
    for (const auto& each : shown.population)
        CHECK(each.fitness.feasible());
}

TEST_CASE("what was scored by one policy is compared by no other") {
    CHECK(!Fitness().minimises());
    CHECK(!Fitness(Name(std::string("pareto f1 f2")), Point{1, 2}).minimises()); // turned already
    CHECK_THROWS_AS(better(fitness(1, false, 0, "a"), fitness(2, false, 0, "b")), UsageError);
    const auto refused = [](const auto& pipeline, const std::string& message) {
        CHECK_THROWS_WITH(run(pipeline, Schaffer{}, nobody), message);
    };
    refused(sample(5) | score("f1") | repeat(2, score("f2") | elite(1)),
            "stage 'elite 1' compares the population, scored by 'f2', with the generation's start, scored by "
            "'f1'; "
            "expected the same for both");
    refused(sample(5) | pareto({"f1", "f2"}) | repeat(2, mutate(1) | score() | plus()),
            "stage 'plus' compares the population, scored by 'f1', with the generation's start, scored by "
            "'pareto f1 "
            "f2'; expected the same for both");
    refused(sample(5) | pareto({"f1", "f2"}) | above(1),
            "stage 'above 1' needs one objective's fitness, the population is ranked by 'pareto f1 f2'; "
            "expected score "
            "before it");
    refused(sample(5) | pareto({"f1", "f2"}) |
                until({.generations = 3, .fitness = 1}, mutate(1) | pareto({"f1", "f2"})),
            "stage 'until generations 3 fitness 1' needs one objective's fitness, the population is ranked "
            "by 'pareto "
            "f1 f2'; expected score before it");
    CHECK_THROWS_WITH(pareto({"f1", "f1"}), "pareto is given 'f1' twice; expected different objectives");
}

TEST_CASE("under several objectives plus, elite and best keep the front of all they choose from") {
    const auto children = tournament(2) | cross(blend()) | mutate(0.5, gaussian(0.05)) | pareto({"f1", "f2"});
    const auto result =
        run(sample(40) | pareto({"f1", "f2"}) | repeat(40, children | plus()), Schaffer{}, nobody);
    REQUIRE(result.population.size() == 40);
    CHECK(result.front.size() == 40);
    for (const auto& a : result.front)
        for (const auto& b : result.front)
            CHECK(!dominates(a.fitness.values(), b.fitness.values()));
    CHECK(result.best->fitness.objective() == "f1"); // the best by the first of them is remembered
    const auto elites =
        run(sample(40) | pareto({"f1", "f2"}) | repeat(40, children | elite(10)), Schaffer{}, nobody);
    CHECK(elites.front.size() >= 10);
}

TEST_CASE("a run under several objectives that stops gives back its population and its front") {
    const auto result =
        run(sample(40) | pareto({"f1", "f2"}) |
                repeat(1000, tournament(2) | mutate(1, gaussian(0.05)) | pareto({"f1", "f2"}) | plus()),
            Schaffer{}, nobody, {.budget = {.evaluations = 410}});
    CHECK(result.stopped == "evaluation budget spent");
    CHECK(result.population.size() >= 40);
    CHECK(result.front.size() > 10);
    CHECK(result.best.has_value());
}

TEST_CASE("under several objectives stagnation counts from the last growth of the hypervolume") {
    std::size_t generations = 0;
    std::vector<double> volumes;
    const auto watch = fronts<std::vector<double>>("plus.1", {-20, -20}, [&](const auto& seen) {
        ++generations;
        CHECK(seen.event.path.ends_with("plus.1"));
        volumes.push_back(seen.hypervolume);
        CHECK(!seen.front.empty());
    });
    const auto result =
        run<Schaffer>(sample(10) | pareto({"f1", "f2"}) |
                          until({.generations = 5000, .stagnation = 30},
                                tournament(2) | mutate(1, gaussian(0.01)) | pareto({"f1", "f2"}) | plus()),
                      Schaffer{}, nobody, {}, {watch});
    CHECK(generations > 31);
    CHECK(generations < 5000);
    CHECK(volumes.back() > volumes.front());
}

TEST_CASE("the hypervolume is the measure of what the points dominate") {
    CHECK(hypervolume({{1, 3}, {2, 2}, {3, 1}}, {0, 0}) == Approx(6));
    CHECK(hypervolume({{1, 3}, {-1, 9}}, {0, 0}) == Approx(3));
    CHECK(hypervolume({}, {0, 0}) == 0);
    CHECK(hypervolume({{1, 1, 1}, {2, 2, 0.5}}, {0, 0, 0}) == Approx(1 + 2 - 0.5));
    // against counting the points of a grid that are dominated
    Stream stream(4);
    std::vector<Point> cloud(12, Point(3));
    for (auto& point : cloud)
        for (double& value : point)
            value = 0.1 * static_cast<double>(1 + stream.below(10));
    double counted = 0;
    for (int i = 0; i < 1000; ++i) {
        const Point cell{0.1 * (i / 100) + 0.05, 0.1 * (i / 10 % 10) + 0.05, 0.1 * (i % 10) + 0.05};
        counted += std::any_of(cloud.begin(), cloud.end(), [&](const Point& p) {
            return p[0] > cell[0] && p[1] > cell[1] && p[2] > cell[2];
        });
    }
    CHECK(hypervolume(cloud, {0, 0, 0}) == Approx(counted / 1000));
}
