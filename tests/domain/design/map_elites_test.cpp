#include "domain/design/search.hpp"
#include "domain/target/like.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("the elites of wave length and skewness are twenty different surfaces with one stiffness curve") {
    DesignSetup setup;
    setup.model.grid = {129, 0.84942};
    std::mt19937_64 random(3);
    const Genome genome =
        rough::testing::random_genome(random, 1, 2, 0.84942, 8 * setup.model.grid.spacing());
    setup.targets = {target_like(sample(genome, setup.model.grid), completed(setup.model), "a genome",
                                 Quantity::stiffness, 12)};
    SearchOptions options;
    options.pipeline =
        "shape 24 | score | best 12 | refine lm 10 | repeat 12 { emit 12 wavelength skewness sigma=0.3 | "
        "score | refine lm 8 | map-elites wavelength skewness cells=12 }";
    options.alternatives = 20;
    options.compared = 1;
    options.threads = 2;
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
