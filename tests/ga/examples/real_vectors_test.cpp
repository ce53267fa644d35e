// Real vectors: Rastrigin's function with one objective, ZDT1 with two.

#include "ga/ga.hpp"
#include "ga/refinement/refinement.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace ga;

namespace {

struct Rastrigin {
    using Genome = std::vector<double>;
    using Outcome = double;

    std::vector<Variable> box;

    explicit Rastrigin(std::size_t n) {
        for (std::size_t i = 0; i < n; ++i)
            box.push_back({i, -5.12, 5.12});
    }
    Outcome evaluate(const Genome& x) const {
        double sum = 0;
        for (const double xi : x)
            sum += xi * xi - 10 * std::cos(2 * std::numbers::pi * xi) + 10;
        return sum;
    }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {
            {"small", [](const double& value) { return -value; }}};
        return list;
    }
    const std::vector<Variable>& bounds(const Genome&) const { return box; }
    std::vector<double> gradient(const Genome& x, const std::string&) const {
        std::vector<double> slope(x.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            slope[i] = -2 * x[i] - 20 * std::numbers::pi * std::sin(2 * std::numbers::pi * x[i]);
        return slope;
    }
    Genome sample(Stream& stream) const {
        Genome x(box.size());
        for (double& gene : x)
            gene = stream.uniform(-5.12, 5.12);
        return x;
    }
};

/// ZDT1 (Zitzler, Deb and Thiele 2000), both objectives to be made small; the front is f2 = 1 - sqrt(f1).
struct Zdt1 {
    using Genome = std::vector<double>;
    using Outcome = std::array<double, 2>;

    Outcome evaluate(const Genome& x) const {
        double g = 0;
        for (std::size_t i = 1; i < x.size(); ++i)
            g += x[i];
        g = 1 + 9 * g / static_cast<double>(x.size() - 1);
        return {x[0], g * (1 - std::sqrt(x[0] / g))};
    }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {{"f1", [](const Outcome& f) { return -f[0]; }},
                                                             {"f2", [](const Outcome& f) { return -f[1]; }}};
        return list;
    }
    std::vector<Variable> bounds(const Genome&) const {
        std::vector<Variable> box;
        for (std::size_t i = 0; i < 30; ++i)
            box.push_back({i, 0, 1});
        return box;
    }
    Genome sample(Stream& stream) const {
        Genome x(30);
        for (double& gene : x)
            gene = stream.uniform();
        return x;
    }
};

const auto nobody = population<std::vector<double>>({{}});

} // namespace

TEST_CASE("simulated binary cross-over finds the bottom of Rastrigin's function among its 10^10 dips") {
    const auto pipeline =
        sample(60) | score() |
        until({.evaluations = 30000, .fitness = -1e-6},
              tournament(2) | cross(sbx(2), 0.9) | mutate(0.1, polynomial(20)) | score() | plus());
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        CHECK(-run(pipeline, Rastrigin(10), nobody, {.seed = seed}).best->value() < 1e-3);
}

TEST_CASE("a gradient method polishes what the search has found, for a few evaluations") {
    const auto rough =
        sample(60) | score() |
        repeat(60, tournament(2) | cross(sbx(2), 0.9) | mutate(0.1, polynomial(20)) | score() | plus());
    const auto polished = rough | best(3) | refine(nlopt_method("LD_LBFGS", 40)) | best(1);
    const auto before = run(rough, Rastrigin(5), nobody), after = run(polished, Rastrigin(5), nobody);
    CHECK(after.counters.asked < before.counters.asked + 300);
    const double x = after.population[0].genome[0]; // at a dip's bottom the slope vanishes
    CHECK(std::abs(Rastrigin(5).gradient(after.population[0].genome, "")[0]) < 1e-3 * (1 + std::abs(x)));
    CHECK(after.population[0].value() >= before.best->value());
}

TEST_CASE("NSGA-II spreads over the known front of ZDT1") {
    const auto nsga2 = sample(100) | pareto({"f1", "f2"}) |
                       repeat(250, tournament(2) | cross(sbx(15), 0.9) | mutate(1.0 / 30, polynomial(20)) |
                                       parents() | pareto({"f1", "f2"}) | best(100)) |
                       front();
    const auto result = run(nsga2, Zdt1{}, nobody);
    CHECK(result.population.size() >= 90);
    std::vector<std::array<double, 2>> points;
    for (const auto& each : result.population)
        points.push_back(Zdt1{}.evaluate(each.genome));
    double generational = 0;
    for (const auto& [f1, f2] : points) {
        double nearest = HUGE_VAL;
        for (int k = 0; k <= 1000; ++k)
            nearest = std::min(nearest, std::hypot(f1 - k / 1000.0, f2 - (1 - std::sqrt(k / 1000.0))));
        generational += nearest / static_cast<double>(points.size());
    }
    CHECK(generational < 1e-2);
    // no part of the front is left out
    for (int k = 0; k <= 20; ++k) {
        double nearest = HUGE_VAL;
        for (const auto& [f1, f2] : points)
            nearest = std::min(nearest, std::hypot(f1 - k / 20.0, f2 - (1 - std::sqrt(k / 20.0))));
        CHECK(nearest < 0.05);
    }
}
