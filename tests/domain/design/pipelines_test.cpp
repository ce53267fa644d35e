#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/stored.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace rough;

namespace {

/// The drawn target on few nodes, on a line or a map.
DesignSetup drawn(bool area) {
    DesignSetup setup;
    setup.model.grid.nodes = area ? 16 : 64;
    if (area) {
        setup.model.grid.rows = setup.model.grid.nodes;
        setup.model.grid.width = setup.model.grid.length;
    }
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = 1.6e-4;
    return completed(setup);
}

std::string found_by(const DesignSetup& setup, const std::string& pipeline, long evaluations,
                     int threads = 1) {
    SearchOptions options;
    options.pipeline = pipeline;
    options.evaluations = evaluations;
    options.alternatives = 1;
    options.threads = threads;
    return shape_key(search(setup, options).best.genome);
}

} // namespace

TEST_CASE(
    "every named variant finds the same genome by its name, by its text, and in any variant of that text") {
    for (const bool area : {false, true}) {
        DesignSetup setup = drawn(area);
        setup.targets.push_back(setup.targets[0]); // for mcco and nsga2
        for (const auto& [name, text] : design_variants()) {
            if (area != (name == "maps")) // on an area each other would press the database anew
                continue;
            INFO(name << (area ? " on an area" : ""));
            setup.like = name == "like"
                             ? std::optional(sample(shaped_start(setup, ga::Stream(3)), setup.model.grid))
                             : std::nullopt;
            const std::string run =
                search(setup, {.pipeline = name, .seconds = 0, .evaluations = 1}).pipeline;
            const std::string by_name = found_by(setup, name, 120);
            CHECK(found_by(setup, text, 120, 2) == by_name);
            CHECK(found_by(setup, run, 120) == by_name);
        }
    }
}

TEST_CASE("a budget in evaluations is kept to, and a pipeline of a coarser grid pays from the same") {
    const DesignSetup setup = drawn(true);
    for (const long budget : {1L, 17L, 30L}) {
        SearchOptions options;
        options.pipeline = "coarser 1 { shape 4 | score | refine lm 5 } | score | refine lm 20 | best 1";
        options.evaluations = budget;
        options.alternatives = 1;
        const SearchResult found = search(setup, options);
        CHECK(found.counters.asked == budget);
        CHECK(found.stopped == "evaluation budget spent");
    }
}

TEST_CASE("the default search begins anew until an answer has the required similarity") {
    DesignSetup setup = drawn(false);
    SearchOptions options;
    options.pipeline = "pass";
    const long once = search(setup, options).counters.asked;
    options.pipeline = "default";
    setup.required_similarity = -1;
    CHECK(search(setup, options).counters.asked == once);
    setup.required_similarity = 1.1; // nothing has that
    options.evaluations = 2 * once;
    const long twice = search(setup, options).counters.asked;
    CHECK(twice > once);
    CHECK(twice <= 2 * once);
}

TEST_CASE("corrected targets bring an answer nearer at its worst") {
    const DesignSetup setup = drawn(true);
    SearchOptions options;
    options.alternatives = 1;
    const std::string before = "shape 6 | score | best 2 | refine lm 20 | best 1";
    options.pipeline = before;
    const double plain = search(setup, options).best.lowest();
    options.pipeline = before + " | corrected { score | refine lm 12 sharpen=4 | best 1 } | score";
    CHECK(search(setup, options).best.lowest() > plain);
}

TEST_CASE("an answer outside the limits on shape is brought within them, and one inside is left alone") {
    DesignSetup setup = drawn(false);
    SearchOptions options;
    options.pipeline = "shape 1 | score";
    const Answer free = search(setup, options).best;
    const auto slope = [&](const Genome& genome) {
        for (const Margin& margin : margins(genome, setup.model.grid, setup.limits))
            if (margin.name == "slope")
                return margin.value;
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

TEST_CASE("a block that changes the problem is refused on islands") {
    const DesignSetup setup = drawn(false);
    CHECK_THROWS_WITH(
        expect_searchable(setup, "shape 8 | score | islands 2 { corrected { score } | score | best 4 }"),
        Catch::Contains("islands"));
}
