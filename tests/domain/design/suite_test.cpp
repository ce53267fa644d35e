#include "domain/design/search.hpp"
#include "tests/domain/design/setups.hpp"

using namespace rough;

TEST_CASE("the drawn target is met to 0.99 from each seed", "[long]") {
    const DesignSetup setup = testing::drawn(512);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) CHECK(search(setup, {.seed = seed}).best.lowest() >= 0.99);
}

TEST_CASE("the variant atlas finds twenty different surfaces with one stiffness curve", "[long]") {
    const DesignSetup setup = testing::drawn(129);
    const SearchResult found = search(setup, {.pipeline = "atlas", .alternatives = 20});
    REQUIRE(found.alternatives.size() == 20);
    std::vector<Profile> profiles;
    for (const Answer& answer : found.alternatives) {
        CHECK(answer.similarity >= 0.97);
        profiles.push_back(sample(answer.genome, setup.model.grid));
    }
    for (std::size_t i = 0; i < profiles.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(difference(profiles[i], profiles[j]) >= different);
}
