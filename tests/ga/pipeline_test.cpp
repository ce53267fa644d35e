#include "ga/pipeline/ask_tell.hpp"
#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

double height(const Vector& x) { return -functions::sphere(x); }

const std::string searching =
    "sample 12 | score | repeat 4 { tournament 2 | cross blend | mutate 0.3 | score | elite 1 } | "
    "islands 3 rounds=2 { mutate 0.3 | score } | best 3 | refine nlopt LN_COBYLA 5 | best 2";

/// Reals that only the caller evaluates.
Reals outside() {
    Reals problem;
    problem.f = [](const Vector&) -> Vector { throw std::logic_error("evaluated inside"); };
    return problem;
}

} // namespace

TEST_CASE("an algorithm of the paper gives the same bits on 1, 2 and 5 threads") {
    const auto check = [](const std::string& pipeline, double expected) {
        const auto with = [&](int threads) {
            return run(pipeline, CurveFit{}, CurveFit::start(60), {.threads = threads});
        };
        const auto one = with(1);
        REQUIRE(one.population.size() == 1);
        CHECK(one.population[0].value() > expected);
        CHECK(bits_of(one) == bits_of(with(2)));
        CHECK(bits_of(one) == bits_of(with(5)));
    };
    check("score | best 3 | refine mma 5 genes=tenth | refine minimax 8 | best 1", 0.9); // SOG
    check("pair(score low | above 0.8 at_least=3, score high | above 0.9 at_least=3, mean) | score | best 3 | "
          "refine mma 3 genes=tenth | refine lm 20 | best 1",
          0.999999); // GCO
}

TEST_CASE("an observer sees every stage under its path with each candidate's parents") {
    std::vector<std::string> paths;
    std::vector<std::size_t> parents;
    const Observer<Vector> observer = [&](const auto& event) {
        paths.push_back(event.path);
        parents.push_back(event.population[0].parents.size());
    };
    run("pair(score low | above 0.8 at_least=3, score high | above 0.9 at_least=3, mean) | score | best 3 | "
        "refine mma 3 genes=tenth | refine mma 2 genes=tenth | best 1",
        CurveFit{}, CurveFit::start(60), {.variant = "gco"}, {observer});
    CHECK(paths == std::vector<std::string>{"gco/pair.1/left/score.1", "gco/pair.1/left/above.1",
                                            "gco/pair.1/right/score.1", "gco/pair.1/right/above.1", "gco/pair.1",
                                            "gco/score.1", "gco/best.1", "gco/refine.1", "gco/refine.2", "gco/best.2"});
    CHECK(parents == std::vector<std::size_t>{0, 0, 0, 0, 2, 2, 2, 2, 2, 2});
}

TEST_CASE("a pipeline that cannot work is refused before anything is evaluated") {
    long calls = 0;
    CurveFit problem;
    problem.on_evaluation = [&](const Vector&) { ++calls; };
    for (const auto& [pipeline, message] : std::map<std::string, std::string>{
             {"best 1 | score", "stage 'best 1' needs a scored population; put score before it"},
             {"score | score middle", "stage 'score middle': unknown objective 'middle'; use one of fit, low, high"},
             {"score | elite 1", "stage 'elite 1' reads the start of a generation"},
             {"score | front", "stage 'front' needs a population ranked by pareto"},
             {"refine lm 3", "stage 'refine lm 3 genes=all' needs a scored population"},
             {"islands 2 rounds=2 { turn genes }", "needs a scored population"},
             {"score low | repeat 2 { score high | elite 1 }",
              "stage 'elite 1' compares the population, scored by 'high', with the generation's start, "
              "scored by 'low'"},
             {"pareto fit low | repeat 2 { mutate 1 | score | plus }",
              "scored by 'pareto fit low'; score both by the same objective"},
             {"pareto fit low | above 1", "stage 'above 1' needs one objective's fitness, the population is "
                                          "ranked by 'pareto fit low'"},
             {"pareto fit low | until fitness 1 { mutate 1 | pareto fit low }", "needs one objective's fitness"}})
        CHECK_THROWS_WITH(run(pipeline, problem, CurveFit::start(5)), Catch::Contains(message));
    CHECK(calls == 0);
    CHECK_THROWS_WITH(run("score", CurveFit{}, {}),
                      "the population is empty; give at least one individual, or begin with sample");
    Reals aimless;
    aimless.list.clear();
    CHECK_THROWS_WITH(run("sample 1 | score", aimless), "the problem has no objective; define at least one");
}

TEST_CASE("grouping by | changes neither text nor random numbers") {
    const auto left = (reals("sample 9") | reals("score")) | reals("mutate 1") | reals("score");
    const auto right = reals("sample 9") | (reals("score | mutate 1") | reals("score"));
    CHECK(left.text() == right.text());
    CHECK(bits_of(run(left, Reals{}, {})) == bits_of(run(right, Reals{}, {})));
}

TEST_CASE("a scored start competes for the best, unless another problem scored it") {
    const auto first = run("sample 20 | score | best 5", maximum(2, height, -1, 1));
    std::string shown;
    const Observer<Vector> list = [&](const auto& event) { shown += event.path + " "; };
    const auto kept = run("best 3", maximum(2, height, -1, 1), first.population, {.seed = 2}, {list});
    CHECK(shown == "pipeline/given pipeline/best.1 ");
    REQUIRE(kept.best);
    CHECK(kept.population.size() == 3);
    CHECK(kept.best->value() == first.best->value());
    CHECK(run("repeat 3 { random | mutate 1 gaussian 1 | score | elite 1 }", maximum(2, height, -1, 1),
              first.population, {.seed = 2})
              .best->value() >= first.best->value());
    const auto other = run("score | best 1", maximum(2, [](const Vector& x) { return 1000 + x[0]; }), first.population);
    CHECK(other.counters.evaluations == 5);
    CHECK(other.best->value() == 1000 + other.best->genome[0]);
}

TEST_CASE("individuals of two runs get different identities when they are joined") {
    auto both = run("sample 10 | score", Reals{}, {}, {.seed = 1}).population;
    const auto other = run("sample 10 | score", Reals{}, {}, {.seed = 2}).population;
    both.insert(both.end(), other.begin(), other.end());
    const auto all = identities_of(run("score | repeat 1 { mutate 0.9 | score | parents }", Reals{}, both).population);
    CHECK(std::set<Identity>(all.begin(), all.end()).size() == 40);
}

TEST_CASE("bounds that do not fit are refused") {
    const auto refused = [](std::vector<Variable> box, const std::string& pipeline, const std::string& message) {
        Reals problem;
        problem.box = [box](const Vector&) { return box; };
        CHECK_THROWS_WITH(run("sample 2 | score | " + pipeline + " | score", problem), Catch::Contains(message));
    };
    refused({{1, -1, 1}, {0, -1, 1}}, "cross blend", "ascending order");
    refused({{0, -1, 1}, {0, -1, 1}}, "mutate 1", "ascending order");
    refused({{0, 1, -1}, {1, -1, 1}}, "mutate 1", "above the upper");
    refused({{7, 0, 1}}, "refine nlopt LN_COBYLA 3", "refine: gene 7");
    refused({{0, -HUGE_VAL, HUGE_VAL}}, "refine nlopt GN_CRS2_LM 8", "refine nlopt GN_CRS2_LM: finite domain");
}

TEST_CASE("means of replicates flatter the best less than single draws, more replicates still less") {
    Reals problem = maximum(1, height, -3, 3);
    problem.noise = 1;
    const auto flattery = [&](const std::string& scored, const std::string& again) { // mean over ten runs
        double mean = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const auto result =
                run("sample 20 | " + scored + " | repeat 20 { tournament 2 | cross blend | mutate 0.5 | " + scored +
                        " | elite 2" + again + " }",
                    problem, {}, {.seed = seed});
            mean += (result.best->value() - height(result.best->genome)) / 10;
        }
        return mean;
    };
    CHECK(flattery("score", "") > 1.5);
    CHECK(std::abs(flattery("average 25", "") - 0.3) < 0.5);
    const double once = flattery("average 5", "");
    CHECK(flattery("average 5 limit=200", " | average 5 limit=200") < 0.7 * once);
}

TEST_CASE("an average is the mean of replicates up to its limit, each paid once") {
    Reals problem = given();
    problem.noise = 1;
    const auto result =
        run("score | average 2 | repeat 10 { average 2 limit=9 }", problem, individuals({1, 0, 0.5, -0.75}));
    CHECK((result.counters.evaluations == 4 * 9 && result.counters.requested == 4 * 9));
    for (const auto& each : result.population) {
        double mean = 0;
        for (std::uint64_t replicate = 0; replicate < 9; ++replicate)
            mean += problem.evaluate(each.genome, replicate)[0] / 9;
        CHECK(each.fitness.replicates() == 9);
        CHECK(each.value() == Approx(mean));
    }
}

TEST_CASE("ask and tell give the bits of a run, whatever the order of answers") {
    const auto inside = run(searching, Reals{}, {}, {.seed = 5});
    AskTell<Reals> search(reals(searching), outside(), {}, {.seed = 5});
    std::size_t told = 0;
    for (auto proposals = search.ask(); !proposals.empty(); proposals = search.ask()) {
        CHECK(proposals.front().id == told);
        std::reverse(proposals.begin(), proposals.end());
        if (proposals.size() > 1) { // answers one proposal; all other proposals are returned again
            const auto [id, genome] = proposals.back();
            proposals.pop_back();
            search.tell(id, genome);
            CHECK(search.ask().size() == proposals.size());
            ++told;
        }
        for (const auto& [id, genome] : proposals) search.tell(id, genome);
        told += proposals.size();
    }
    CHECK(bits_of(search.result()) == bits_of(inside));
    CHECK(told == static_cast<std::size_t>(inside.counters.evaluations));
}

TEST_CASE("ask and tell return what is known when the caller ends early") {
    AskTell<Reals> search(reals(searching), outside());
    auto proposals = search.ask();
    REQUIRE(proposals.size() == 12);
    for (std::size_t i = 0; i < 5; ++i) search.tell(proposals[i].id, proposals[i].genome);
    search.fail(proposals[5].id, "broke");
    const auto part = search.result();
    CHECK(part.stopped == "stop requested");
    CHECK(part.population.size() == 6);
    CHECK(part.counters.evaluations == 6);
    CHECK(part.counters.failures == 1);
    CHECK(search.ask().empty());
    search.tell(proposals[7].id, proposals[7].genome); // too late, and no matter

    AskTell<Reals> by_time(reals(searching), outside(), {}, {.budget = {.seconds = 0.01}});
    while (!by_time.ask().empty()) {
    }
    CHECK(by_time.result().stopped == "time budget spent");
}

TEST_CASE("ask and tell throw the run's errors to the caller") {
    CHECK_THROWS_WITH(AskTell<Reals>(reals("score | best 1"), outside()),
                      "the population is empty; give at least one individual, or begin with sample");
    AskTell<Reals> failing(reals(searching), outside());
    for (const auto& proposal : failing.ask()) failing.fail(proposal.id, "broke");
    for (auto open = failing.ask(); !open.empty(); open = failing.ask())
        for (const auto& proposal : open) failing.fail(proposal.id, "broke");
    CHECK_THAT(failing.result().stopped, Catch::Contains(" evaluations failed; the first: broke"));

    const Observer<Vector> breaks = [](const auto&) { throw std::runtime_error("seen enough"); };
    AskTell<Reals> watched(reals(searching), outside(), {}, {}, {breaks});
    CHECK_THROWS_WITH(watched.ask(), "seen enough");

    AskTell<Reals> search(reals(searching), outside());
    const auto proposals = search.ask();
    search.tell(0, proposals[0].genome);
    CHECK_THROWS_WITH(search.tell(0, proposals[0].genome), "proposal 0 is not open; answer one that ask returned");
    CHECK_THROWS_AS(search.tell(12, {}), UsageError);
}
