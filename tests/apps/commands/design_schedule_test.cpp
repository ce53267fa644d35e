#include "apps/commands/design/schedule.hpp"
#include "domain/design/starts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("of a time limit that is long for its curves the search gets most, and of none everything") {
    rough::DesignSetup setup;
    setup.model.grid.nodes = 64;
    setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup = completed(setup);
    const rough::Genome start = shaped_start(setup, ga::Stream(1));
    const app::Schedule day(ga::Stopwatch(), 86400, setup, start, 1, false);
    CHECK(day.for_search() > 0.5 * 86400);
    CHECK(day.for_search() < 86400);
    const app::Schedule endless(ga::Stopwatch(), HUGE_VAL, setup, start, 1, true);
    CHECK(endless.for_search() == HUGE_VAL);
    CHECK(endless.has_time_for_page());
}
