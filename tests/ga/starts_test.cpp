#include "ga/adaptation/cma_es.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace ga;

namespace {

using Numbers = std::vector<double>;

/// One objective of two genes, given by a function; what it throws goes on.
struct Function {
    using Genome = Numbers;
    using Outcome = double;

    std::function<double(const Numbers&)> of;
    std::vector<Variable> box = {{0, -1, 1}, {1, -1, 1}};

    double evaluate(const Numbers& x) const { return of(x); }
    const std::vector<Objective<double>>& objectives() const {
        static const std::vector<Objective<double>> list = {
            {"value", [](const double& value) { return value; }}};
        return list;
    }
    std::vector<Variable> bounds(const Numbers&) const { return box; }
    Numbers sample(Stream& stream) const { return {stream.uniform(-1, 1), stream.uniform(-1, 1)}; }
};

double height(const Numbers& x) { return -x[0] * x[0] - x[1] * x[1]; }

/// Counts its checks.
struct Counted : Operator {
    long* count;
    static Words words() { return {"counted", "test", "counts its checks"}; }
    static void describe(auto&, auto) {}
    void check(CheckState&) const { ++*count; }
    PopulationOf<Function> operator()(PopulationOf<Function> all, Context<Function>&) const { return all; }
};

} // namespace

TEST_CASE("a scored start is offered to the best, and scored again where another problem scored it") {
    const Function problem{height};
    const auto first = run(sample(20) | score() | best(5), problem, {}, {.seed = 1});
    const auto kept = run(best(3), problem, first.population, {.seed = 2});
    REQUIRE(kept.best);
    CHECK(kept.population.size() == 3);
    CHECK(kept.best->value() == first.best->value());
    const auto elite_kept = run(repeat(3, at_random() | mutate(1.0, gaussian(1)) | score() | elite(1)),
                                problem, first.population, {.seed = 2});
    CHECK(elite_kept.best->value() >= first.best->value());
    const Function other{[](const Numbers& x) { return 1000 + x[0]; }};
    const auto scored = run(score() | best(1), other, first.population);
    CHECK(scored.counters.evaluations == 5);
    CHECK(scored.best->value() == other.of(scored.best->genome));
}

TEST_CASE("individuals of two runs that are joined get identities of their own") {
    const Function problem{height};
    auto both = run(sample(10) | score(), problem, {}, {.seed = 1}).population;
    const auto other = run(sample(10) | score(), problem, {}, {.seed = 2}).population;
    both.insert(both.end(), other.begin(), other.end());
    const auto all = run(score() | repeat(1, mutate(0.9) | score() | parents()), problem, both);
    std::set<Identity> identities;
    for (const auto& each : all.population)
        identities.insert(each.identity);
    CHECK(identities.size() == 40);
}

TEST_CASE("a run whose fitness is never a number ends at once and says so") {
    const Function nowhere{[](const Numbers&) { return std::nan(""); }};
    long calls = 0;
    const Observer<Numbers> count = [&](const auto& event) { calls = event.counters.evaluations; };
    const Stage<Function> pipeline = sample(10) | score() | repeat(100, mutate(0.5) | score()) | best(1);
    CHECK_THROWS_WITH(run(pipeline, nowhere, {}, {}, {count}),
                      Catch::Contains("every one of 10 evaluations"));
    CHECK(calls == 0);
}

TEST_CASE("cma-es goes on from a start that fails") {
    const Function problem{[](const Numbers& x) {
        if (x == Numbers{0.5, 0.5})
            throw std::runtime_error("here is nothing");
        return height(x);
    }};
    const auto found = run(score() | repeat(30, cma_es() | score()), problem,
                           population<Numbers>({{0.5, 0.5}}), {.seed = 3});
    REQUIRE(found.best);
    CHECK(found.best->value() > -1e-3);
}

TEST_CASE("a problem that stops the run gives its own reason") {
    const Function problem{[](const Numbers& x) -> double {
        if (x[0] > 0.3)
            throw Stopped{"the licence has run out"};
        return height(x);
    }};
    const auto found = run(sample(20) | score() | best(1), problem, {}, {.seed = 1});
    CHECK(found.stopped == "the licence has run out");
}

TEST_CASE("a check takes time in proportion to the depth of blocks") {
    long checks = 0;
    Counted counted;
    counted.count = &checks;
    Stage<Function> stage = counted | score();
    for (int depth = 0; depth < 40; ++depth)
        stage = Stage<Function>(repeat(1, stage));
    run(sample(2) | stage, Function{height}, {});
    CHECK(checks <= 3 * 40);
}

TEST_CASE("bounds out of order, what is no permutation and more threads than can be are refused in words") {
    Function problem{height, {{1, -1, 1}, {0, -1, 1}}};
    CHECK_THROWS_WITH(run(sample(2) | score() | cross(blend()) | score(), problem, {}),
                      Catch::Contains("ascending order"));
    problem.box = {{0, 1, -1}, {1, -1, 1}};
    CHECK_THROWS_WITH(run(sample(2) | mutate(1.0) | score(), problem, {}),
                      Catch::Contains("above the upper"));
    CHECK_THROWS_WITH(thread_count(100000), Catch::Contains("at most 1024"));
    struct Orders {
        using Genome = Permutation;
        using Outcome = double;
        double evaluate(const Permutation& x) const { return static_cast<double>(x.order[0]); }
        const std::vector<Objective<double>>& objectives() const {
            static const std::vector<Objective<double>> list = {{"first", [](const double& v) { return v; }}};
            return list;
        }
    };
    for (const Permutation& wrong : {Permutation{{0, 1, 5}}, Permutation{{1, 1, 2}}})
        CHECK_THROWS_WITH(run(score() | best(1), Orders{}, population<Permutation>({wrong})),
                          Catch::Contains("expected each from 0 to 2 once"));
}
