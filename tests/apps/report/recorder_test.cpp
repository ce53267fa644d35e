#include "apps/report/record.hpp"
#include "tests/catch.hpp"

using namespace app;

TEST_CASE("a resumed run records the stages of an interrupted derived problem once") {
    std::vector<StageRecord> stages;
    const ga::Population<rough::Genome> population(1);
    const ga::Counters counters;
    const auto run = [&](const std::vector<std::pair<std::string, bool>>& events) {
        const auto observe = recorder(stages);
        for (const auto& [path, derived] : events) observe({path, {}, population, counters, 0, derived});
    };
    run({{"v/sample.1", false}, {"v/independent.1/score.1", true}, {"v/independent.1/best.1", true}});
    run({{"v/independent.1/score.1", true}, {"v/independent.1/best.1", true}, {"v/independent.1", false}});
    run({{"v/score.1", false}});
    std::string paths;
    for (const StageRecord& stage : stages) paths += stage.path + " ";
    CHECK(paths == "v/sample.1 v/independent.1/score.1 v/independent.1/best.1 v/independent.1 v/score.1 ");
}

TEST_CASE("the record of an endless run stays bounded and keeps its last generation") {
    std::vector<StageRecord> stages;
    const auto observe = recorder(stages);
    const ga::Population<rough::Genome> population(1000);
    ga::Counters counters;
    for (long generation = 0; generation < 500; ++generation)
        for (const std::string path : {"v/repeat.1/cross.1", "v/repeat.1/score.1"}) {
            counters.price = static_cast<double>(generation);
            observe({path, {static_cast<std::size_t>(generation)}, population, counters, 0});
        }
    CHECK(stages.size() == max_candidates / 1000);
    CHECK(stages.front().spent == 0);
    CHECK(stages.back().path == "v/repeat.1/score.1");
    CHECK(stages.back().spent == 499);
    const std::string end = "v/best.1";
    observe({end, {}, population, counters, 0});
    CHECK(stages.back().path == end);
}
