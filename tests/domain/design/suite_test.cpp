#include "domain/design/search.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/out_of_reach.hpp"
#include "tests/domain/design/suite.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE(
    "of twenty targets those that a profile can meet are met on both grids, the others called out of reach",
    "[long]") {
    int attainable = 0, met = 0;
    for (const suite::Asked& asked : suite::targets()) {
        DesignSetup setup;
        setup.targets = {asked.target};
        setup.limits.shortest_wave = 8 * setup.model.grid.spacing();
        INFO(asked.target.name);
        CHECK(out_of_reach(setup.targets, setup.model).empty() == asked.attainable);
        if (!asked.attainable)
            continue;
        ++attainable;
        const Answer best = search(setup).best;
        WARN(asked.target.name << ": " << best.similarity << ", refined " << best.similarity_refined);
        met += best.lowest() >= 0.99;
    }
    CHECK(attainable == 17);
    CHECK(met >= 16);
}

TEST_CASE("the drawn target is met to 0.99 at its worst from any seed", "[long]") {
    DesignSetup setup;
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = 1.6e-4;
    setup.limits.shortest_wave = 8 * setup.model.grid.spacing();
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SearchOptions options;
        options.seed = seed;
        CHECK(search(setup, options).best.lowest() >= 0.99);
    }
}

TEST_CASE("the elites of wave length and skewness are twenty different surfaces with one stiffness curve",
          "[long]") {
    DesignSetup setup;
    setup.model.grid = {129, 0.84942};
    setup.max_pressure = 1.6e-4;
    setup.targets = {read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    SearchOptions options;
    options.pipeline = "atlas";
    options.alternatives = 20;
    const SearchResult found = search(setup, options);
    REQUIRE(found.alternatives.size() == 20);
    std::vector<Profile> profiles;
    for (const Answer& answer : found.alternatives) {
        CHECK(answer.similarity >= 0.97);
        profiles.push_back(sample(answer.genome, setup.model.grid));
    }
    for (std::size_t i = 0; i < profiles.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            CHECK(difference(profiles[i], profiles[j]) >= different);
}
