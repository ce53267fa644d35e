#include "ga/checkpoint/checkpoint.hpp"
#include "tests/folder.hpp"
#include "tests/ga/curve_fit.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace ga;

namespace {

/// Everything a result says, for comparing bit for bit.
std::string all_of(const Result<CurveFit::Genome>& result) {
    std::string text;
    for (const auto& each : result.population) {
        text += std::to_string(each.identity) + ":";
        for (const Identity parent : each.parents)
            text += std::to_string(parent) + ",";
        for (const double gene : each.genome)
            text += number(gene) + " ";
        text += number(each.value()) + "\n";
    }
    return text + std::to_string(result.counters.asked) + " " + std::to_string(result.counters.evaluations) +
           " " + std::to_string(result.counters.gradients);
}

Result<CurveFit::Genome> run_with(int threads, const auto& pipeline) {
    return run(pipeline, CurveFit{}, CurveFit::start(60), {.threads = threads});
}

} // namespace

TEST_CASE("an algorithm reads as on paper and gives the same bits on 1, 2 and 5 threads") {
    const auto sog = score() | best(3) | refine(mma(5), tenth) | refine(minimax(8)) | best(1);
    const auto gco =
        pair(score("low") | above(0.8, at_least(3)), score("high") | above(0.9, at_least(3)), mean) |
        score() | best(3) | refine(mma(3), tenth) | refine(lm(20)) | best(1);
    const auto check = [](const auto& pipeline, double expected) {
        const auto one = run_with(1, pipeline);
        REQUIRE(one.population.size() == 1);
        CHECK(one.population[0].value() > expected);
        CHECK(all_of(one) == all_of(run_with(2, pipeline)));
        CHECK(all_of(one) == all_of(run_with(5, pipeline)));
    };
    check(sog, 0.9);
    check(gco, 0.999999);
}

TEST_CASE("an observer sees every stage under its path and each candidate's parents") {
    const auto gco =
        pair(score("low") | above(0.8, at_least(3)), score("high") | above(0.9, at_least(3)), mean) |
        score() | best(3) | refine(mma(3), tenth) | refine(mma(2), tenth) | best(1);
    std::vector<std::string> paths;
    std::vector<std::size_t> parents;
    const Observer<CurveFit::Genome> observer = [&](const auto& event) {
        paths.push_back(event.path);
        parents.push_back(event.population[0].parents.size());
    };
    run<CurveFit>(gco, CurveFit{}, CurveFit::start(60), {.variant = "gco"}, {observer});
    CHECK(paths == std::vector<std::string>{"gco/pair.1/left/score.1", "gco/pair.1/left/above.1",
                                            "gco/pair.1/right/score.1", "gco/pair.1/right/above.1",
                                            "gco/pair.1", "gco/score.1", "gco/best.1", "gco/refine.1",
                                            "gco/refine.2", "gco/best.2"});
    CHECK(parents == std::vector<std::size_t>{0, 0, 0, 0, 2, 2, 2, 2, 2, 2});
}

TEST_CASE("one evaluation serves every objective, and no genome is evaluated twice") {
    auto twice = CurveFit::start(20);
    for (const auto& individual : CurveFit::start(20))
        twice.push_back(individual);
    const auto result = run(score("low") | score("high") | score(), CurveFit{}, twice);
    CHECK(result.counters.evaluations == 20);
    CHECK(result.counters.asked == 40);
    CHECK(result.counters.remembered == 100);
}

TEST_CASE("a memory too small to hold anything changes no result") {
    const auto turned = transform("turn", [](const CurveFit::Genome& g) {
        return CurveFit::Genome{g[1], g[2], g[0]};
    });
    const auto pipeline =
        score() | repeat(6, turned | score("low") | score()) | refine(mma(2), tenth) | best(2);
    const auto large = run(pipeline, CurveFit{}, CurveFit::start(40));
    const auto small = run(pipeline, CurveFit{}, CurveFit::start(40), {.memory_bytes = 1});
    CHECK(large.counters.evaluations == 3 * 40 + 40);
    CHECK(small.counters.evaluations == 7 * 40 + 40);
    CHECK(small.counters.asked == large.counters.asked);
    CHECK(small.population[0].genome == large.population[0].genome);
}

TEST_CASE("an outcome that says nothing of its memory weighs what one does that owns nothing besides") {
    /// A square, of weight 0 where it is said.
    struct Square {
        using Genome = std::vector<double>;
        using Outcome = double;
        double evaluate(const Genome& g) const { return g[0] * g[0]; }
        const std::vector<Objective<double>>& objectives() const {
            static const std::vector<Objective<double>> list = {{"f", [](const double& y) { return y; }}};
            return list;
        }
    };
    struct Weightless : Square {
        std::size_t bytes(const double&) const { return 0; }
    };
    std::vector<std::vector<double>> genomes;
    for (int i = 0; i < 60; ++i)
        genomes.push_back({i + 0.0});
    const auto by = [](double step) {
        return transform("by",
                         [step](const std::vector<double>& g) { return std::vector<double>{g[0] + step}; });
    };
    std::set<long> seen;
    for (double bytes = 2000; bytes < 40000; bytes *= 1.01) { // some forget the first batch by the third
        const auto evaluations = [&](const auto& problem) {
            return run(score() | by(1000) | score() | by(-1000) | score(), problem, population(genomes),
                       {.threads = 1, .memory_bytes = static_cast<std::size_t>(bytes)})
                .counters.evaluations;
        };
        seen.insert(evaluations(Square{}));
        REQUIRE(evaluations(Square{}) == evaluations(Weightless{}));
    }
    CHECK(seen == std::set<long>{120, 180});
}

TEST_CASE("an evaluation that throws marks its individual, which ranks last and keeps the reason") {
    auto start = CurveFit::start(5);
    start[2].genome[1] = -21;
    start[3].genome[0] = std::nan("");
    const auto result = run(score() | best(5), CurveFit{}, start, {.threads = 2});
    CHECK(result.counters.failures == 2);
    CHECK(result.population[3].fitness.reason() == "rate under -20");
    CHECK(result.population[4].fitness.reason() == "fitness fit is nan");
    CHECK(result.best->identity == result.population[0].identity);
}

TEST_CASE("a run in which every evaluation fails ends with the first reason") {
    auto start = CurveFit::start(2);
    start[0].genome[1] = start[1].genome[1] = -21;
    CHECK_THROWS_WITH(run(score(), CurveFit{}, start),
                      "every one of 2 evaluations failed; the first: rate under -20");
}

TEST_CASE("an unscored fitness cannot be read") {
    CHECK_THROWS_AS(CurveFit::start(1)[0].value(), UsageError);
}

TEST_CASE("a pipeline that cannot work is refused before anything is evaluated") {
    const auto refused = [](const auto& pipeline, const std::string& message) {
        long calls = 0;
        struct Counting : CurveFit {
            long* calls;
            Outcome evaluate(const Genome& g) const { return ++*calls, CurveFit::evaluate(g); }
        } problem;
        problem.calls = &calls;
        CHECK_THROWS_WITH(run(pipeline, problem, CurveFit::start(5)), message);
        CHECK(calls == 0);
    };
    refused(best(1) | score(), "stage 'best 1' needs a scored population; expected score before it");
    refused(score() | score("middle"),
            "stage 'score middle': unknown objective 'middle'; expected one of fit, low, high");
    refused(refine(lm(3)),
            "stage 'refine lm 3 genes=all' needs a scored population; expected score before it");
    refused(until({.fitness = 1}, transform("same", [](const CurveFit::Genome& g) { return g; })),
            "stage 'until fitness 1' needs a scored population; expected score before it");
}

TEST_CASE("a threshold that nobody passes takes the best at_least and says so, or ends the run") {
    const auto result =
        run(score() | above(2, at_least(3)), CurveFit{}, CurveFit::start(10), {.variant = "v"});
    CHECK(result.population.size() == 3);
    CHECK(result.notes == std::vector<std::string>{"v/above.1: 0 of 10 above 2; took the 3 best"});
    CHECK_THROWS_WITH(run(score() | above(2), CurveFit{}, CurveFit::start(10), {.variant = "v"}),
                      "v/above.1: 0 of 10 above 2; expected one at least, or at_least=K");
}

TEST_CASE("an evaluation budget ends a run exactly, with the best so far") {
    const auto pipeline = score() | repeat(1000, refine(mma(2), tenth));
    const auto whole = run(score() | best(1), CurveFit{}, CurveFit::start(30));
    const auto part = run(score() | best(1), CurveFit{}, CurveFit::start(30), {.budget = {.evaluations = 7}});
    CHECK(part.counters.evaluations == 7);
    CHECK(part.stopped == "evaluation budget spent");
    CHECK(part.population.size() == 7);
    CHECK(part.population[0].value() <= whole.population[0].value());
    const auto refined = run(pipeline, CurveFit{}, CurveFit::start(5), {.budget = {.evaluations = 200}});
    CHECK(refined.counters.asked <= 200);
    CHECK(refined.best->value() >= run(score(), CurveFit{}, CurveFit::start(5)).best->value());
}

TEST_CASE("a stop request ends a run at once with the population it has, best first") {
    std::atomic<bool> stop = false;
    long stages = 0;
    const Observer<CurveFit::Genome> observer = [&](const auto&) { stop = ++stages == 3; };
    const auto result = run<CurveFit>(score() | repeat(1000, refine(mma(2), tenth)), CurveFit{},
                                      CurveFit::start(5), {.budget = {.stop = &stop}}, {observer});
    CHECK(result.stopped == "stop requested");
    CHECK(stages == 3);
    REQUIRE(result.population.size() == 5);
    CHECK(result.population[0].identity == result.best->identity);
}

TEST_CASE("grouping by | changes neither paths nor random numbers") {
    const Stage<CurveFit> left = Stage<CurveFit>(score() | best(3)) | best(2);
    const Stage<CurveFit> right = score() | Stage<CurveFit>(best(3) | best(2));
    CHECK(left.text() == "score | best 3 | best 2");
    CHECK(right.text() == left.text());
}

TEST_CASE("bounds of a second refinement are those of the original genome") {
    const auto start = CurveFit::start(1);
    const auto result = run(score() | repeat(50, refine(lm(5), tenth)), CurveFit{}, start);
    const auto& genome = result.population[0].genome;
    for (std::size_t i = 0; i < genome.size(); ++i) {
        CHECK(genome[i] >= 0.9 * start[0].genome[i]);
        CHECK(genome[i] <= 1.1 * start[0].genome[i]);
    }
    CHECK(*result.population[0].origin == start[0].genome);
    CHECK(result.population[0].identity == start[0].identity);
}

TEST_CASE("a run that is told nothing draws by seed 1") {
    const auto pipeline = score() | mutate(0.5) | score();
    const auto plain = run(pipeline, CurveFit{}, CurveFit::start(5)),
               seeded = run(pipeline, CurveFit{}, CurveFit::start(5), {.seed = 1}),
               other = run(pipeline, CurveFit{}, CurveFit::start(5), {.seed = 2});
    CHECK(all_of(plain) == all_of(seeded));
    CHECK(all_of(plain) != all_of(other));
}

namespace {

/// Given values whose reading throws: under 0 a std::exception, above 100 something else.
struct Fragile : Given {
    const std::vector<Objective<double>>& objectives() const {
        static const auto read = [](const double& value) {
            if (value < 0)
                throw std::domain_error("under 0");
            if (value > 100)
                throw 7;
            return value;
        };
        static const std::vector<Objective<double>> list = {{"value", read},
                                                            {"other", [](const double& y) { return -y; }}};
        return list;
    }
};

} // namespace

TEST_CASE("an objective that throws, whatever it throws, marks its individual with the reason") {
    const std::vector<std::string> reasons = {"", "under 0", "an exception that is no std::exception"};
    const auto start = Fragile::of({1, -1, 101});
    const auto check = [&](const Stage<Fragile>& stage) {
        for (const int threads : {1, 2}) {
            const auto result = run(stage, Fragile{}, start, {.threads = threads});
            REQUIRE(result.population.size() == 3);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(result.population[i].fitness.reason() == reasons[i]);
            CHECK(result.best->identity == 0);
        }
    };
    check(score());
    check(pareto({"other", "value"}));
    check(pareto({"value", "other"}));
    CHECK(run(score("other"), Fragile{}, start).counters.failures == 0);
}

TEST_CASE("a transformation that throws, whatever it throws, leaves the genome and marks its individual") {
    const auto half = transform("half", [](const std::vector<double>& g) {
        if (g[0] < 0)
            throw std::domain_error("under 0");
        if (g[0] > 100)
            throw 7;
        return std::vector<double>{g[0] / 2};
    });
    const tests::Folder folder;
    for (const bool scored : {false, true}) {
        Checkpoints<Given> keeper(folder / "run", "", false, 0);
        const Stage<Given> before = scored ? Stage<Given>(score() | half) : Stage<Given>(half);
        const auto result = run(before | half | score(), Given{}, Given::of({8, -1, 101}), {}, {}, &keeper);
        CHECK(result.population[0].value() == 2);
        CHECK(result.population[1].genome == std::vector<double>{-1});
        CHECK(result.population[1].fitness.reason() == "under 0");
        CHECK(result.population[2].genome == std::vector<double>{101});
        CHECK(result.population[2].fitness.reason() == "an exception that is no std::exception");
    }
}

TEST_CASE("an objective or a transformation that throws Stopped ends the run, and nobody has failed") {
    struct Ending : Given {
        const std::vector<Objective<double>>& objectives() const {
            static const std::vector<Objective<double>> list = {
                {"value", [](const double& y) { return y > 2 ? throw Stopped{"asked"} : y; }}};
            return list;
        }
    };
    const auto asked = [](const Stage<Ending>& stage, const std::vector<double>& start) {
        const auto result = run(stage, Ending{}, Given::of(start), {.threads = 2});
        CHECK(result.stopped == "asked");
        CHECK(result.counters.failures == 0);
    };
    asked(score(), {1, 2, 3});
    asked(score() |
              transform("end",
                        [](const std::vector<double>& g) { return g[0] > 1 ? throw Stopped{"asked"} : g; }) |
              score(),
          {1, 2});
}

TEST_CASE("a pair's twins are one child, and who gives no child is passed over") {
    const auto result = run(score() | pair(score(), score(), mean) | score(), CurveFit{}, CurveFit::start(3));
    CHECK(result.population.size() == 3); // of nine pairs three are of one and three are twins
    CHECK(result.population[0].parents == Parents(0, 1));
}

TEST_CASE("what islands remark stands among the run's notes, each under its island's path") {
    const auto pipeline =
        score() | islands(2, {.rounds = 1, .migrants = 0}, score() | above(50, at_least(2)));
    const auto result = run(pipeline, Given{}, Given::of({1, 2, 3, 4, 5, 6}));
    CHECK(result.notes ==
          std::vector<std::string>{"pipeline/islands.1/island1/above.1: 0 of 3 above 50; took the 2 best",
                                   "pipeline/islands.1/island2/above.1: 0 of 3 above 50; took the 2 best"});
}

TEST_CASE("a problem without an objective is refused") {
    struct Aimless : Given {
        std::vector<Objective<double>> none;
        const std::vector<Objective<double>>& objectives() const { return none; }
    };
    CHECK_THROWS_WITH(run(score(), Aimless{}, Given::of({1})),
                      "the problem has no objective; expected one at least");
}
