#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

TEST_CASE("a block `until` ends at the first condition that holds") {
    const auto start = run("sample 20 | score", Reals{}).population;
    const auto generations = [&](const std::string& end) {
        std::size_t count = 0;
        const Observer<Vector> observer = [&](const auto& event) { count += event.path.ends_with("elite.1"); };
        run("until " + end + " " + generation, Reals{}, start, {}, {observer});
        return count;
    };
    CHECK(generations("generations 7") == 7);
    CHECK(generations("generations 7 evaluations 60") == 3);
    CHECK(generations("seconds 0") == 0);
    CHECK(generations("generations 5 fitness -100") == 0);
    const auto stuck = generations("generations 100000 stagnation 10");
    CHECK((stuck > 10 && stuck < 100000));
    CHECK(run("until fitness -1e-3 " + generation, Reals{}, start).best->value() >= -1e-3);
    CHECK(run("until seconds 0 " + generation, Reals{}, start, {.variant = "v"}).notes ==
          std::vector<std::string>{"v/until.1: ended after its seconds; another run may end in another generation"});
}

TEST_CASE("an endless block ends after 10,000 generations without progress, with a note") {
    for (const std::string end : {"fitness 1", "evaluations 1000"})
        CHECK(run("sample 3 | score | until " + end + " { best 3 }", Reals{}, {}, {.variant = "v"}).notes ==
              std::vector<std::string>{"v/until.1: ended after 10000 generations without progress towards its end"});
}

TEST_CASE("blocks inside each other, and a long repeat, end together after 10,000 idle generations") {
    for (const std::string block :
         {"until evaluations 100 { until evaluations 50 { cross uniform | score } }",
          "repeat 1000000000 { until fitness 1 { cross uniform | score } }", "repeat 1000000000 { score }"}) {
        std::size_t stages = 0;
        const Observer<Vector> count = [&](const auto&) { ++stages; };
        const auto result = run("sample 1 | score | " + block + " | best 1", Reals{}, {}, {}, {count});
        CHECK(result.stopped.empty());
        CHECK(!result.notes.empty());
        CHECK((stages > 10000 && stages < 50000));
    }
    const auto after = run("sample 1 | score | repeat 20000 { score } | repeat 2 { mutate 1 | score }", Reals{});
    CHECK(after.counters.requested == 3); // a later block begins
}

TEST_CASE("islands evolve independently and return one population") {
    std::vector<std::string> paths;
    const Observer<Vector> observer = [&](const auto& event) {
        if (event.path.ends_with("elite.1") && event.generation.back() == 1) paths.push_back(event.path);
    };
    const auto result =
        run("sample 30 | score | islands 3 rounds=20 " + generation, Reals{}, {}, {.variant = "v"}, {observer});
    CHECK(result.population.size() == 30);
    CHECK(paths == std::vector<std::string>{"v/islands.1/island1/elite.1", "v/islands.1/island2/elite.1",
                                            "v/islands.1/island3/elite.1"});
    CHECK(result.best->value() > -1e-2);
    const auto apart = run("score | islands 2 rounds=5 migrants=0 { repeat 3 { tournament 2 } }", given(),
                           individuals({0, 1, 2, 3, 4, 5, 6, 7}));
    for (std::size_t i = 0; i < 8; ++i) // no ancestor is shared
        CHECK(apart.population[i].identity % 2 == (i < 4 ? 0 : 1));
}

TEST_CASE("a migrant replaces the worst of the next island") {
    Vector values =
        values_of(run("score | islands 2 rounds=2 { random }", given(), individuals({0, 1, 2, 3})).population);
    std::sort(values.begin(), values.begin() + 2);
    std::sort(values.begin() + 2, values.end());
    CHECK(values == Vector{2, 3, 2, 3});
}

TEST_CASE("islands inside islands never give one identity to two individuals") {
    std::map<Identity, Vector> genomes; // genomes of all individuals of the run
    const Observer<Vector> observer = [&](const auto& event) {
        for (const auto& each : event.population)
            CHECK(genomes.try_emplace(each.identity, each.genome).first->second == each.genome);
    };
    const std::string child = "mutate 1 | score", apart = "islands 2 rounds=3 migrants=0 { ";
    const auto result =
        run("sample 16 | score | " + apart + child + " | " + apart + child + " } | " + child + " } | " + child, Reals{},
            {}, {}, {observer});
    CHECK(genomes.size() == 16 * (1 + 3 * (1 + 3 + 1) + 1));
    CHECK(result.population.size() == 16);
    const auto all = identities_of(result.population);
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("nested islands run on a bounded number of threads, with the same bits for any") {
    std::string first;
    for (const int threads : {1, 3}) {
        std::atomic<long> most = 0; // threads of the process during an evaluation
        Reals problem;
        problem.f = [&](const Vector& x) {
            const auto tasks = std::filesystem::directory_iterator("/proc/self/task");
            const long count = std::distance(begin(tasks), end(tasks));
            for (long seen = most; count > seen && !most.compare_exchange_weak(seen, count);)
                ;
            return x;
        };
        const auto result = run("sample 400 | score | islands 20 rounds=2 migrants=1 { "
                                "islands 20 rounds=1 migrants=1 { mutate 0.5 | score } }",
                                problem, {}, {.threads = threads});
        CHECK(result.population.size() == 400);
        CHECK(most <= 64 + 64 + 8);
        CHECK((first.empty() || bits_of(result) == first));
        first = bits_of(result);
    }
}

TEST_CASE("restarts join the answers of different runs") {
    const auto result = run("restarts 4 { sample 5 | score | best 1 }", Reals{});
    REQUIRE(result.population.size() == 4);
    for (std::size_t i = 1; i < 4; ++i) CHECK(result.population[i].genome != result.population[0].genome);
}

TEST_CASE("a pair takes each child once and skips parents that have none") {
    const auto result = run("score | pair(score, score, mean) | score", CurveFit{}, CurveFit::start(3));
    CHECK(result.population.size() == 3); // three of nine pairs have one parent and three are repeated
    CHECK(result.population[0].parents == Parents(0, 1));
}

TEST_CASE("a stage with too few individuals ends the run and says how many") {
    Reals problem = minimum(2, functions::sphere);
    problem.features = {{"none", [](const Vector&) { return std::nan(""); }, -1, 1}};
    const auto ends = [&](const std::string& stage, const std::string& message) {
        const auto result = run("sample 3 | score | above -1e9 | " + stage + " | score", problem);
        CHECK(result.stopped == "pipeline/" + message);
        CHECK(result.is_dead_end);
        CHECK(result.population.size() == 3);
        CHECK(result.best->identity == result.population[0].identity);
        CHECK(result.counters.evaluations == 3);
    };
    ends("below -1", "below.1: 0 of 3 below -1; change the bound, or give at_least=K");
    ends("islands 4 { score }", "islands.1: 3 individuals for 4 islands; give at least one for each");
    ends("repeat 2 { l-shade | score | duel }", "repeat.1/l-shade.1: 3 individuals; give 4 or more");
    ends("de", "de.1: 3 individuals; give 4 or more");
    ends("pair(score | best 2, score, none)",
         "pair.1: 2 and 3 individuals gave no child by none; pair other individuals");
    ends("repeat 2 { map-elites none | score }",
         "repeat.1/map-elites.1: no individual has descriptors that are numbers; return finite descriptors");
}
