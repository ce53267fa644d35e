#include "ga/observers/coco.hpp"
#include "ga/observers/hall_of_fame.hpp"
#include "ga/observers/log.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"
#include "tests/ga/problems.hpp"

#include <sstream>

using namespace ga;

namespace {

namespace fs = std::filesystem;

const std::string logged =
    "sample 20 | score | repeat 10 { tournament 2 | cross blend | mutate 0.1 | score | elite 2 }";

/// The table without its last column, the seconds.
std::string timeless(const std::string& table) {
    std::istringstream lines(table);
    std::string text;
    for (std::string line; std::getline(lines, line);)
        text += line.substr(0, line.rfind(',')) + "\n";
    return text;
}

} // namespace

TEST_CASE("a log has one row per stage with the population's fitness") {
    const tests::Folder folder;
    const fs::path file = folder / "log.csv";
    const Reals problem;
    Log log(file);
    const auto result = run(logged, problem, {}, {.variant = "v"}, {log.observer(problem)});
    CHECK(!fs::exists(file));
    log.close();
    std::istringstream lines(contents(file));
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);)
        rows.push_back(line);
    REQUIRE(rows.size() == 1 + 2 + 10 * 5 + 1);
    CHECK(
        rows[0] ==
        "path,generation,individuals,best,median,diversity,requested,evaluations,gradients,failures,price,seconds");
    CHECK(rows[1].starts_with("v/sample.1,,20,,,1,0,0,0,0,"));
    CHECK(rows[2].starts_with("v/score.1,,20,-"));
    CHECK(rows[52].starts_with("v/repeat.1/elite.1,9,20," + number(result.best->value())));
    Log empty(folder / "empty.csv");
    empty.close();
    CHECK(contents(folder / "empty.csv") == rows[0] + "\n");
}

TEST_CASE("a log that cannot be written does not stop the run and is reported") {
    const tests::Folder folder;
    const Reals problem;
    Log whole(folder / "whole.csv"), nowhere(folder / "gone" / "log.csv"), full(folder / "full.csv");
    fs::create_symlink("/dev/full", folder / "full.csv.part");
    const auto result = run(logged, problem, {}, {},
                            {whole.observer(problem), nowhere.observer(problem), full.observer(problem)});
    CHECK(result.stopped.empty());
    Log taken(folder / "taken.csv");
    run(logged, problem, {}, {}, {taken.observer(problem)});
    fs::remove(folder / "taken.csv.part");
    taken.close();
    CHECK_FALSE(taken.trouble.empty());
    for (Log* log : {&whole, &nowhere, &full})
        log->close();
    CHECK(whole.trouble.empty());
    CHECK(nowhere.trouble.find("log.csv' cannot be written") != std::string::npos);
    CHECK(full.trouble.find("full.csv' cannot be written") != std::string::npos);
    CHECK(full.position == 0);
    CHECK_FALSE(fs::exists(folder / "full.csv"));
}

TEST_CASE("a log and a hall of fame continue when the run is resumed") {
    const tests::Folder folder;
    const Reals problem;
    Log whole(folder / "whole.csv");
    run(logged, problem, {}, {}, {whole.observer(problem)});
    whole.close();
    HallOfFame<Reals> all(problem, 5);
    run(logged, problem, {}, {}, {all.observer()});
    std::string stopped = "not yet";
    for (long budget = 15; !stopped.empty(); budget += 40) {
        Log log(folder / "parts.csv");
        HallOfFame<Reals> hall(problem, 5);
        Checkpoints<Reals> checkpoints(folder / "run", "", true);
        checkpoints.keep("log", log.position);
        checkpoints.keep("hall", hall.members);
        stopped = run(logged, problem, {}, {.budget = {.evaluations = budget}},
                      {log.observer(problem), hall.observer()}, &checkpoints)
                      .stopped;
        if (budget % 3 == 0) // an interrupted run leaves a table, a killed one does not
            log.close();
        if (stopped.empty()) {
            log.close();
            REQUIRE(hall.members.size() == 5);
            for (std::size_t i = 0; i < 5; ++i)
                CHECK(hall.members[i].genome == all.members[i].genome);
        }
    }
    CHECK(timeless(contents(folder / "parts.csv")) == timeless(contents(folder / "whole.csv")));

    Log lost(folder / "lost.csv");
    lost.position = 10;
    CHECK_THROWS_AS(run(logged, problem, {}, {}, {lost.observer(problem)}), UsageError);
}

TEST_CASE("a hall of fame keeps the best different genomes, best first") {
    Reals problem = given();
    problem.f = [](const Vector& x) { return Vector{x[0] > 5 ? std::nan("") : x[0]}; };
    HallOfFame<Reals> hall(problem, 3);
    run("score | best 2 | repeat 1 { below 100 }", problem, individuals({1, 5, 3, 5, 6, 4}), {},
        {hall.observer()});
    CHECK(values_of(hall.members) == Vector{5, 4, 3});
    CHECK(hall.members[0].identity == 1);
}

TEST_CASE("the status names place, generation, best and evaluations") {
    std::vector<std::string> lines;
    const Reals problem;
    run(logged, problem, {}, {.variant = "v"},
        {progress<Vector>([&](const std::string& line) { lines.push_back(line); }, 0)});
    CHECK(lines[0] == "v/sample.1, 0 evaluations");
    CHECK(lines[7].starts_with("v/repeat.1/tournament.1 generation 2: best -0."));
    CHECK(lines.back().ends_with(" evaluations"));
}

TEST_CASE("a summary has count, best, median and share of different individuals") {
    const Reals problem = given();
    const auto of = [&](const std::vector<double>& values) {
        return summary(problem, run("score", problem, individuals(values)).population);
    };
    const Summary odd = of({7, 1, 2, 1, 9}), even = of({10, 4, 1, 2});
    CHECK(odd.individuals == 5);
    CHECK(odd.best == 9.0);
    CHECK(odd.median == 2.0);
    CHECK(odd.diversity == 0.8);
    CHECK(even.median == 3.0);
    const Summary unscored = summary(problem, individuals({1, 2})), none = summary(problem, {});
    CHECK(unscored.individuals == 2);
    CHECK((!unscored.best && !unscored.median));
    CHECK((unscored.diversity == 1 && none.diversity == 0));
}

TEST_CASE("COCO's files have every improvement of a run and its evaluations") {
    const tests::Folder folder;
    CocoFunction sphere{3, 6, {{1, {}}, {2, {}}}};
    for (CocoRun& one : sphere.runs) {
        const auto result =
            run("sample 4 | score | repeat 20 { tournament 2 | mutate 0.3 gaussian | score | plus }",
                maximum(6, [](const Vector& x) { return 7 - functions::sphere(x); }), {},
                {.seed = std::uint64_t(one.instance)}, {coco_observer<Vector>(one, 7)});
        CHECK(one.evaluations == result.counters.evaluations);
        CHECK(one.found.back().second == 7 - result.best->value());
        for (auto now = one.found.begin(), next = now + 1; next != one.found.end(); now = next++)
            CHECK((next->first >= now->first && next->second < now->second));
    }
    sphere.runs.push_back({3, {}}); // a run without evaluations
    write_coco(folder / "coco", "ga", {sphere});
    const auto [first, second] = std::pair(sphere.runs[0], sphere.runs[1]);
    CHECK_THAT(contents(folder / "coco/bbobexp_f3.info"),
               Catch::Contains("DIM = 6") &&
                   Catch::Contains(", 2:" + std::to_string(second.evaluations) + "|" +
                                   number(second.found.back().second) + ", 3:0|"));
    for (const auto& [evaluations, precision] : first.found)
        CHECK_THAT(contents(folder / "coco/data_f3/bbobexp_f3_DIM6.dat"),
                   Catch::Contains("\n" + std::to_string(evaluations) + " " + number(precision) + " "));
}
