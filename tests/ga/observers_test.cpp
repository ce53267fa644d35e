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
    for (std::string line; std::getline(lines, line);) text += line.substr(0, line.rfind(',')) + "\n";
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
    for (std::string line; std::getline(lines, line);) rows.push_back(line);
    REQUIRE(rows.size() == 1 + 2 + 10 * 5 + 1);
    CHECK(rows[0] == "path,generation,individuals,best,median,diversity,requested,evaluations,gradients,"
                     "failures,price,seconds");
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
    const auto result =
        run(logged, problem, {}, {}, {whole.observer(problem), nowhere.observer(problem), full.observer(problem)});
    CHECK(result.stopped.empty());
    Log taken(folder / "taken.csv");
    run(logged, problem, {}, {}, {taken.observer(problem)});
    fs::remove(folder / "taken.csv.part");
    taken.close();
    CHECK_FALSE(taken.trouble.empty());
    for (Log* log : {&whole, &nowhere, &full}) log->close();
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
            for (std::size_t i = 0; i < 5; ++i) CHECK(hall.members[i].genome == all.members[i].genome);
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
    run("score | best 2 | repeat 1 { below 100 }", problem, individuals({1, 5, 3, 5, 6, 4}), {}, {hall.observer()});
    CHECK(values_of(hall.members) == Vector{5, 4, 3});
    CHECK(hall.members[0].identity == 1);
}
