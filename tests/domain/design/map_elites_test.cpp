#include "domain/design/search.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/target.hpp"

#include <catch2/catch.hpp>

using namespace rough;

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
