#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/stored.hpp"
#include "tests/domain/design/setups.hpp"

using namespace rough;
using testing::drawn;

namespace {

std::string found_by(const DesignSetup& setup, const std::string& pipeline, long evaluations, int threads = 1) {
    const SearchOptions options{
        .pipeline = pipeline, .threads = threads, .evaluations = evaluations, .alternatives = 1};
    return shape_key(search(setup, options).best.genome);
}

} // namespace

TEST_CASE("every named variant finds the same genome by its name and by its text") {
    for (const bool area : {false, true}) {
        DesignSetup setup = drawn(area ? 16 : 64, area);
        setup.targets.push_back(setup.targets[0]); // for mcco and nsga2
        for (const auto& [name, text] : design_variants()) {
            if (area != name.starts_with("maps")) // on a map all others would solve the whole database
                continue;
            INFO(name << (area ? " on an area" : ""));
            setup.measured = name.ends_with("like")
                                 ? std::optional(sample(shaped_start(setup, ga::Stream(3)), setup.model.grid))
                                 : std::nullopt;
            const std::string run = search(setup, {.pipeline = name, .seconds = 0, .evaluations = 1}).pipeline;
            const std::string by_name = found_by(setup, name, 120);
            CHECK(found_by(setup, text, 120, 2) == by_name);
            CHECK(found_by(setup, run, 120) == by_name);
        }
    }
}

TEST_CASE("a coarser grid is paid for from the run's budget of evaluations") {
    for (const long budget : {1L, 17L, 30L}) {
        const SearchResult found = search(
            drawn(16, true), {.pipeline = "coarser 1 { shape 4 | score | refine lm 5 } | score | refine lm 20 | best 1",
                              .evaluations = budget,
                              .alternatives = 1});
        CHECK(found.counters.requested_price <= static_cast<double>(budget));
        CHECK(found.counters.requested_price > static_cast<double>(budget) - 2);
        CHECK(found.stopped == "evaluation budget spent");
    }
}

TEST_CASE("the default search restarts until an answer has the required similarity") {
    DesignSetup setup = drawn(64);
    const auto cost = [&](const char* pipeline, double price) {
        return search(setup, {.pipeline = pipeline, .evaluations = static_cast<long>(price)}).counters.requested_price;
    };
    setup.required_similarity = -1; // which every answer has
    const double once = cost("pass", 1000000);
    CHECK(cost("default", 1000000) == once);
    setup.required_similarity = 1.1; // which no answer has
    const double twice = cost("default", 2 * once);
    CHECK(twice > once);
    CHECK(twice <= 2 * once);
}

TEST_CASE("corrected targets raise the lowest similarity of an answer") {
    const std::string before = "shape 6 | score | best 2 | refine lm 20 | best 1",
                      after = before + " | corrected { score | refine lm 12 sharpen=4 | best 1 } | score";
    const auto lowest = [](const std::string& pipeline) {
        return search(drawn(24, true), {.pipeline = pipeline, .alternatives = 1}).best.lowest();
    };
    CHECK(lowest(after) > lowest(before));
}

TEST_CASE("only an answer outside the limits on shape is changed to keep them") {
    DesignSetup setup = drawn(64);
    const SearchOptions options{.pipeline = "shape 1 | score"};
    const Answer free = search(setup, options).best;
    const auto slope = [&](const Genome& genome) {
        for (const Margin& margin : margins(genome, setup.model.grid, setup.limits))
            if (margin.name == "slope") return margin.value;
        return 0.0;
    };
    const double steep = slope(free.genome);
    setup.limits.max_slope = 0.6 * steep;
    const SearchResult within = search(setup, options);
    CHECK(within.pipeline.find("within-limits { ") != std::string::npos);
    CHECK(within.best.within_limits);
    CHECK(slope(within.best.genome) <= 0.6 * steep);
    setup.limits.max_slope = 2 * steep;
    const SearchResult same = search(setup, options);
    CHECK(shape_key(same.best.genome) == shape_key(free.genome));
    CHECK(same.counters.gradients == 0);
}

TEST_CASE("islands refuse a block that changes the problem") {
    CHECK_THROWS_WITH(
        expect_searchable(drawn(64), "shape 8 | score | islands 2 { corrected { score } | score | best 4 }"),
        Catch::Contains("islands"));
}

TEST_CASE("a body that cannot work is refused in every block before anything is evaluated") {
    const DesignSetup setup = drawn(64);
    const auto refused = [&](const std::string& pipeline) {
        CHECK_THROWS_WITH(expect_searchable(setup, "shape 8 | " + pipeline),
                          Catch::Contains("'best 1' needs a scored population"));
    };
    const auto registry = design_registry(setup);
    for (const auto& entry : registry.entries())
        if (entry.bodies > 0) {
            INFO(entry.name);
            std::string block = entry.name == "until" ? "until generations 2" : entry.name;
            for (const auto& parameter : entry.parameters) block += parameter.standard ? "" : " 2";
            refused(block + " { best 1 }");
        }
    for (const std::string block : {"corrected", "coarser 2"}) { // other problems, whose fitness is another
        refused("score | " + block + " { best 1 }");
        refused("score | " + block + " { score } | best 1");
    }
}
