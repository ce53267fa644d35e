#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

const Population<std::vector<double>> nobody = population<std::vector<double>>({{}});

/// Best fitness after each generation of a run.
std::vector<double> bests(const auto& body, bool& same_size) {
    std::vector<double> bests;
    same_size = true;
    const Observer<std::vector<double>> observer = [&](const auto& event) {
        if (event.generation.empty() || !event.population[0].fitness.known())
            return;
        double best = -HUGE_VAL;
        for (const auto& each : event.population)
            best = std::max(best, each.value());
        if (event.path.find("elite") + 1 || event.path.find("plus") + 1 || event.path.find("steady") + 1) {
            bests.push_back(best);
            same_size &= event.population.size() == 20;
        }
    };
    run<Vectors>(sample(20) | score() | repeat(60, body), Vectors{}, nobody, {}, {observer});
    return bests;
}

} // namespace

TEST_CASE(
    "with an elite, plus or steady replacement the size stays, and with the first two the best never falls") {
    const auto check = [](const auto& body, bool rises) {
        bool same_size = false;
        const auto series = bests(body, same_size);
        CHECK(series.size() == 60);
        CHECK(same_size);
        if (rises)
            CHECK(std::is_sorted(series.begin(), series.end()));
        CHECK(series.back() > series.front());
    };
    check(tournament(2) | cross(uniform()) | mutate(0.2) | score() | elite(1), true);
    check(tournament(2) | cross(uniform()) | mutate(0.2) | score() | elite(5), true);
    check(tournament(2) | cross(uniform()) | mutate(0.2) | score() | plus(), true);
    check(tournament(2) | cross(uniform()) | mutate(0.2) | score() | plus(20), true);
    check(tournament(2, 2) | cross(blend()) | score() | steady(), false);
}

TEST_CASE("elite, plus and steady outside a generation are refused") {
    const std::string message = "' reads the start of a generation; expected it inside repeat or until";
    CHECK_THROWS_WITH(run(score() | elite(1), Given{}, Given::of({1})), "stage 'elite 1" + message);
    CHECK_THROWS_WITH(run(score() | plus(5), Given{}, Given::of({1})), "stage 'plus 5" + message);
    CHECK_THROWS_WITH(run(score() | steady(), Given{}, Given::of({1})), "stage 'steady" + message);
    CHECK_THROWS_WITH(run(repeat(3, score() | elite(2)), Given{}, Given::of({1})),
                      "stage 'repeat 3' needs a scored population; expected score before it");
}

TEST_CASE("steady replaces the worst by the children whatever they are worth") {
    const auto result =
        run(score() |
                repeat(1, best(1) |
                              transform("zero",
                                        [](const std::vector<double>&) { return std::vector<double>{-7}; }) |
                              score() | steady()),
            Given{}, Given::of({3, 1, 2}));
    std::vector<double> values;
    for (const auto& each : result.population)
        values.push_back(each.value());
    CHECK(values == std::vector<double>{3, -7, 2});
}

TEST_CASE("until ends at the first condition that holds") {
    const auto body = tournament(2) | cross(blend()) | mutate(0.2) | score() | elite(1);
    const auto start = run(sample(20) | score(), Vectors{}, nobody).population;
    const auto generations = [&](Until end) {
        std::size_t count = 0;
        const Observer<std::vector<double>> observer = [&](const auto& event) {
            count += event.path.ends_with("elite.1");
        };
        run<Vectors>(until(end, body), Vectors{}, start, {}, {observer});
        return count;
    };
    CHECK(generations({.generations = 7}) == 7);
    CHECK(generations({.generations = 7, .evaluations = 60}) == 3);
    CHECK(generations({.seconds = 0}) == 0);
    CHECK(run(until({.seconds = 0}, body), Vectors{}, start, {.variant = "v"}).notes ==
          std::vector<std::string>{"v/until.1: ended on seconds; another run may end elsewhere"});
    CHECK(generations({.generations = 5, .fitness = -100}) == 0);
    const auto reached = run(until({.fitness = -1e-3}, body), Vectors{}, start);
    CHECK(reached.best->value() >= -1e-3);
    const auto stuck = generations({.generations = 100000, .stagnation = 10});
    CHECK((stuck > 10 && stuck < 100000));
    CHECK_THROWS_AS(until({}, body), UsageError);
}

TEST_CASE("islands evolve apart but for migrants, and come back as one population") {
    const auto body = tournament(2) | cross(blend()) | mutate(0.1) | score() | elite(1);
    std::vector<std::string> paths;
    const Observer<std::vector<double>> observer = [&](const auto& event) {
        if (event.path.ends_with("elite.1") && event.generation.back() == 1)
            paths.push_back(event.path);
    };
    const auto result = run<Vectors>(sample(30) | score() | islands(3, {.rounds = 20, .migrants = 1}, body),
                                     Vectors{}, nobody, {.variant = "v"}, {observer});
    CHECK(result.population.size() == 30);
    CHECK(paths == std::vector<std::string>{"v/islands.1/island1/elite.1", "v/islands.1/island2/elite.1",
                                            "v/islands.1/island3/elite.1"});
    CHECK(result.best->value() > -1e-2);
    // without migrants no ancestor is shared
    const auto apart = run(score() | islands(2, {.rounds = 5, .migrants = 0}, repeat(3, tournament(2))),
                           Given{}, Given::of({0, 1, 2, 3, 4, 5, 6, 7}));
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(apart.population[i].identity % 2 == (i < 4 ? 0 : 1));
}

TEST_CASE("no two individuals of islands within islands share an identity") {
    const Migration apart{.rounds = 3, .migrants = 0};
    const auto inner = islands(2, apart, mutate(1) | score());
    std::map<Identity, std::vector<double>> genomes; // of everybody that ever was
    const Observer<std::vector<double>> observer = [&](const auto& event) {
        for (const auto& each : event.population)
            CHECK(genomes.try_emplace(each.identity, each.genome).first->second == each.genome);
    };
    const auto result = run<Vectors>(
        sample(16) | score() | islands(2, apart, mutate(1) | score() | inner | mutate(1) | score()) |
            mutate(1) | score(),
        Vectors{}, nobody, {}, {observer});
    CHECK(genomes.size() == 16 * (1 + 3 * (1 + 3 + 1) + 1));
    CHECK(result.population.size() == 16);
    const auto all = identities_of(result.population);
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE(
    "islands are two to ten thousand, meet once at least, and need a score only where somebody leaves") {
    for (const std::size_t n : {2, 10000})
        CHECK_NOTHROW(islands(n, {.rounds = 1}, score()));
    for (const std::size_t n : {1, 10001})
        CHECK_THROWS_AS(islands(n, {.rounds = 1}, score()), UsageError);
    CHECK_THROWS_AS(islands(2, {.rounds = 0}, score()), UsageError);
    const auto unscored = [](std::size_t migrants) -> Stage<Vectors> {
        return sample(4) | islands(2, {.rounds = 2, .migrants = migrants}, mutate(1)) | score();
    };
    CHECK(run(unscored(0), Vectors{}, nobody).population.size() == 4);
    CHECK_THROWS_AS(check(unscored(1), Vectors{}, nobody), UsageError); // before anything is evaluated
}

TEST_CASE("a migrant replaces the worst of the next island") {
    const auto result = run(score() | islands(2, {.rounds = 2, .migrants = 1}, at_random()), Given{},
                            Given::of({0, 1, 2, 3}));
    std::vector<double> values;
    for (const auto& each : result.population)
        values.push_back(each.value());
    std::sort(values.begin(), values.begin() + 2);
    std::sort(values.begin() + 2, values.end());
    CHECK(values == std::vector<double>{2, 3, 2, 3});
}

TEST_CASE("restarts join the answers of runs that differ") {
    const auto result = run(restarts(4, sample(5) | score() | best(1)), Vectors{}, nobody);
    REQUIRE(result.population.size() == 4);
    for (std::size_t i = 1; i < 4; ++i)
        CHECK(result.population[i].genome != result.population[0].genome);
}
