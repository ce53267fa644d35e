#include "domain/database/law.hpp"
#include "domain/problem/problem.hpp"
#include "tests/apps/experiments/finished.hpp"

using app::testing::Folder;
using app::testing::rugosa;
using nlohmann::json;

namespace {

const std::string coarse =
    "run '" RUGOSA_SOURCE "/experiments/growth.ini' --pictures off --nodes 48 --steps 8 "
    "--set growth.seeds=1 --set growth.budget=60 --set growth.sizes=20,60";

} // namespace

TEST_CASE(
    "a larger database holds the smaller ones: what each stage of growth finds follows from its genomes") {
    const Folder folder;
    const json rows = app::testing::finished(coarse, folder)["rows"];
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

TEST_CASE("growth finds the same on any number of threads, and after an interruption") {
    const Folder folder;
    app::testing::finished(coarse, folder);
    app::testing::expect_repeated(coarse, folder, {"default.csv"});
    const auto timeless = [&](const std::string& out) {
        json rows = app::testing::result_in(folder / out)["rows"];
        for (json& row : rows)
            row.erase("seconds");
        return rows;
    };
    CHECK(timeless("one") == timeless("r"));
    CHECK(timeless("s") == timeless("r"));
    CHECK(rugosa(coarse + " --set growth.sizes=60,20 --out t", folder.path()).code == 2);
}
