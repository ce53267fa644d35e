#include "domain/database/law.hpp"
#include "domain/problem/problem.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using app::testing::Ended;
using app::testing::Folder;
using app::testing::result_in;
using app::testing::rugosa;
using nlohmann::json;

namespace {

const std::string coarse =
    "run '" RUGOSA_SOURCE "/experiments/growth.ini' --pictures off --nodes 48 --steps 8 "
    "--set growth.seeds=1 --set growth.budget=60 --set growth.sizes=20,60 ";

} // namespace

TEST_CASE(
    "a larger database holds the smaller ones: what each stage of growth finds follows from its genomes") {
    const Folder folder;
    const Ended ended = rugosa(coarse + "--out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json rows = result_in(folder / "r")["rows"];
    REQUIRE(rows.size() == 2 * 2 * 3);
    rough::Model model;
    model.grid.nodes = 48;
    model.loading.steps = 8;
    rough::DesignSetup setup;
    setup.model = completed(model);
    setup.targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    setup.max_pressure = 1.6e-4;
    rough::GenomeLaw law;
    law.shortest = setup.model.grid.spacing();
    double best = -HUGE_VAL;
    for (std::uint64_t i = 0; i < 60; ++i) {
        best = std::max(best, similarity(setup, drawn(law, i)));
        if (i == 19)
            CHECK(rows[0]["best_child"].get<double>() == Approx(best).margin(1e-12));
    }
    CHECK(rows[3]["best_child"].get<double>() == Approx(best).margin(1e-12));
    for (const json& row : rows) {
        INFO(row);
        const double child = row["best_child"], answer = row["similarity"];
        CHECK(answer >= child - 1e-9);
        CHECK(row["curves"] >= row["stored"]);
        if (row["variant"] == "sog")
            continue;
        CHECK(row["U1"] >= 3);
        CHECK(row["pairs_tried"] <= row["U1"].get<long>() * row["U2"].get<long>());
        CHECK(row["pairs_tried"] >= row["U1"].get<long>() * row["U2"].get<long>() / 2);
    }
}

TEST_CASE("children given up by the exact bound are none of the best, whatever the threads") {
    const Folder folder;
    REQUIRE(rugosa(coarse + "--threads 1 --out one", folder.path()).code == 0);
    REQUIRE(rugosa(coarse + "--threads 3 --out three", folder.path()).code == 0);
    json one = result_in(folder / "one")["rows"], three = result_in(folder / "three")["rows"];
    for (json* rows : {&one, &three})
        for (json& row : *rows)
            row.erase("seconds");
    CHECK(one == three);
    CHECK(rugosa(coarse + "--set growth.sizes=60,20 --out s", folder.path()).code == 2);
}
