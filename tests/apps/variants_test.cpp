#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using app::testing::Ended;
using app::testing::Folder;
using app::testing::result_in;
using app::testing::rugosa;
using nlohmann::json;

TEST_CASE("ways to search are compared on the same targets with the same budget and seeds") {
    const Folder folder;
    const Ended ended = rugosa(
        "run '" RUGOSA_SOURCE "/experiments/variants.ini' --pictures off --set experiment.budget=150 --set "
        "experiment.seeds=2 --set model.nodes=64 --set targets.shortest-wave=0.06 --out r",
        folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    for (const char* place : {"r", "r/heldout"}) {
        const json result = result_in(folder / place);
        CHECK(result["variants"].size() == 9);
        for (const auto& [name, variant] : result["variants"].items()) {
            INFO(place << " " << name);
            REQUIRE(variant["runs"].size() == 2);
            CHECK(variant["runs"][0]["seed"] == 1);
            CHECK(variant["genome"]["series"].size() >= 1);
            if (name != "cco") // Algorithm 1's own curves are not the search's to count
                CHECK(variant["curves"].get<long>() + variant["gradients"].get<long>() <= 160);
            CHECK(variant["similarity"].get<double>() <= 1);
        }
    }
    const std::string table = rough::read_whole(folder / "r" / "variants.csv");
    CHECK(table.starts_with("target,variant,seed,curves_and_gradients,seconds,similarity\n"));
    CHECK(table.find("heldout,default,2,") != std::string::npos);

    const Ended bad = rugosa(
        "run '" RUGOSA_SOURCE "/experiments/variants.ini' --set variants.mine=bets --out s", folder.path());
    CHECK(bad.code == 2);
    CHECK(bad.error_lines() == 1);
    CHECK(bad.err.find("bets") != std::string::npos);
}
