#include "domain/design/coarse_to_fine.hpp"
#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/trust.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

DesignSetup drawn_area(Index side) {
    DesignSetup setup;
    setup.model.grid.nodes = setup.model.grid.rows = side;
    setup.model.grid.width = setup.model.grid.length;
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = 1.6e-4;
    return completed(setup);
}

} // namespace

TEST_CASE("an area is searched on half and a quarter of its nodes a side, where its waves can be told there",
          "[areas]") {
    const auto sides = [](DesignSetup setup) {
        std::vector<Index> all;
        for (const DesignSetup& one : coarser_grids(setup)) {
            CHECK(one.model.grid.rows == one.model.grid.nodes);
            CHECK(one.limits.shortest_wave == setup.limits.shortest_wave);
            all.push_back(one.model.grid.nodes);
        }
        return all;
    };
    CHECK(sides(drawn_area(128)) == std::vector<Index>{32, 64});
    CHECK(sides(drawn_area(64)) == std::vector<Index>{32});
    CHECK(sides(drawn_area(40)).empty());
    CHECK(sides(drawn_area(256)) == std::vector<Index>{64, 128});
    DesignSetup fine = drawn_area(128);
    fine.limits.shortest_wave = 3 * fine.model.grid.spacing();
    CHECK(sides(fine).empty());
}

TEST_CASE("a target aimed at anew is off by what the judged curves are off in the middle", "[areas]") {
    DesignSetup setup = drawn_area(32);
    setup.targets[0].weight = 0.5;
    Judgement judged;
    for (auto& misfits : judged.misfits)
        misfits = {Eigen::VectorXd::Zero(20)};
    judged.misfits[0][0][3] = 0.01;
    judged.misfits[1][0][3] = 0.05;
    judged.misfits[3][0][3] = -0.02; // 0.015 in the middle
    const DesignSetup aimed = allowing_for(setup, judged);
    CHECK(aimed.targets[0].y[3] == Approx(setup.targets[0].y[3] * (1 + (0.01 - 0.015) / 0.5)));
    CHECK(aimed.targets[0].y[4] == setup.targets[0].y[4]);
}

TEST_CASE("starts shaped to the drawn target on an area are near it before any search", "[areas]") {
    for (const Kernel kernel : {Kernel::free}) {
        DesignSetup setup = drawn_area(32);
        setup.model.body.kernel = kernel;
        int near = 0;
        for (std::uint64_t key = 0; key < 8; ++key) {
            const Genome start = shaped_start(setup, ga::Stream(key));
            REQUIRE(start.series.size() == 2);
            CHECK(shortest_wave(start) >= setup.limits.shortest_wave * (1 - 1e-9));
            near += similarity(setup, start) > 0.7;
        }
        CHECK(near >= 2);
    }
}

TEST_CASE("the default search meets the drawn target on a small area and on one four times finer",
          "[areas]") {
    const DesignSetup setup = drawn_area(24);
    SearchOptions options;
    options.alternatives = 1;
    const SearchResult found = search(setup, options);
    CHECK(found.best.similarity > 0.95);
    CHECK(found.best.similarity_refined > 0.9);
    CHECK(found.best.similarity_worst == found.best.judgement.worst());
    options.threads = 1;
    CHECK(search(setup, options).best.judged() == found.best.judged());
    TrustOptions trust;
    trust.phase_draws = 2;
    const Trust verified = trust_in(setup, found.best.genome, trust, &found.best);
    CHECK(verified.checks.size() == 4); // no datum
    CHECK(verified.checks[2].similarity == found.best.similarity_refined);
    CHECK(verified.checks[1].similarity ==
          Approx(similarity(setup, respond(setup, found.best.genome, refined(setup.model, 2)))));
    CHECK(verified.kernels.size() == 1); // no strip
}
