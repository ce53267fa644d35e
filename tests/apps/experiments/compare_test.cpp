#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string few = "compare --problems bbob5-1,bbob5-8,zdt1,knapsack50,tsp14 --seeds 3 --budget 60*D ";

} // namespace

TEST_CASE("a comparison writes medians, runtimes, shares and tests, the same on any number of threads") {
    const Folder folder;
    for (const int threads : {1, 2, 5}) {
        const std::string out = "t" + std::to_string(threads);
        succeeded(rugosa(few + "--threads " + std::to_string(threads) + " --out " + out, folder.path()));
        for (const char* name : {"runs.csv", "ert.csv", "ecdf.csv", "tests.csv"})
            CHECK(rough::read_whole(folder / out / name) == rough::read_whole(folder / "t1" / name));
    }
    const json result = result_in(folder / "t1");
    CHECK_FALSE(std::filesystem::exists(folder / "t1/coco"));
    CHECK(result["seeds"] == 3);
    CHECK(result["groups"].size() == 4);
    CHECK(result["problems"].size() == 5);
    const json& sphere = result["problems"]["bbob5-1"];
    CHECK(sphere["budget"] == 300);
    CHECK(sphere["targets"].size() == 51);
    for (const auto& [name, variant] : sphere["variants"].items()) {
        INFO(name);
        REQUIRE(variant["runs"].size() == 3);
        CHECK(variant["interval"][0] <= variant["median_precision"]);
        for (const json& run : variant["runs"])
            CHECK(run["evaluations"] <= 300);
    }
    for (const auto& [name, group] : result["groups"].items())
        for (const auto& [variant, one] : group["variants"].items()) {
            INFO(name << " " << variant);
            double before = 0;
            for (std::size_t i = 0; i < one["share"].size(); ++i) {
                CHECK(one["share"][i] >= before); // never falls
                CHECK(one["share_lower"][i] <= one["share"][i]);
                CHECK(one["share_upper"][i] >= one["share"][i]);
                before = one["share"][i];
            }
        }
    const json& first = sphere["variants"].items().begin().value()["runs"][0];
    const long met =
        std::count_if(first["evaluations_to_targets"].begin(), first["evaluations_to_targets"].end(),
                      [](const json& one) { return !one.is_null(); });
    const std::string name = sphere["variants"].items().begin().key(),
                      runs = rough::read_whole(folder / "t1/runs.csv");
    const auto row = runs.find("bbob5-1," + name + ",1," + first["evaluations"].dump() + ",");
    REQUIRE(row != std::string::npos);
    const std::string cells = runs.substr(row, runs.find('\n', row) - row);
    CHECK_THAT(cells, Catch::Contains("," + std::to_string(met) + ","));
    const std::string page = rough::read_whole(folder / "t1/report.html");
    CHECK(page.find("<svg") != std::string::npos);
}

TEST_CASE("variants given by flag or by file run in the place of the usual ones") {
    const Folder folder;
    const Ended ended =
        rugosa("compare --problems bbob5-1 --seeds 2 --budget 500 --variants \"ga, mine=sample 9 | "
               "pair(score, score, union) | best 1\" --out r",
               folder.path());
    INFO(ended.err);
    CHECK(ended.code == 2); // a comma within brackets parts nothing: it is `union` that is not known
    CHECK_THAT(ended.err, Catch::Contains("union"));
    folder.write("c.ini",
                 "[experiment]\nkind = compare\n[compare]\nproblems = tsp14\nseeds = 2\nbudget = 300\n"
                 "[tours]\nmine = sample 9 | score | best 1\nga = ga\n");
    REQUIRE(rugosa("compare c.ini --budget 400 --out c", folder.path()).code == 0);
    REQUIRE(rugosa("run c.ini --pictures off --out d", folder.path()).code == 0);
    const json result = result_in(folder / "c")["problems"]["tsp14"];
    CHECK(result["variants"].size() == 2);
    CHECK(result["variants"].count("mine") == 1);
    CHECK(result["budget"] == 400);
    CHECK(result_in(folder / "d")["problems"]["tsp14"]["budget"] == 300);
}

TEST_CASE("the roughness problem is compared by curves, with similarity for precision") {
    const Folder folder;
    const json result = result_of(
        rugosa("compare --problems roughness --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' "
               "--max-pressure 1.6e-4 --seeds 2 --curves 60 --variants plain,\"mine=sample 20 | score | "
               "best 1\" --out r",
               folder.path()),
        folder / "r")["problems"]["roughness"];
    for (const auto& [name, variant] : result["variants"].items())
        for (const json& run : variant["runs"]) {
            CHECK(run["evaluations"] <= 60);
            CHECK(run["precision"] > 0);
            CHECK(run["precision"] < 1);
        }
}

TEST_CASE("runs on BBOB's functions are written as COCO has them, a folder for each variant") {
    const Folder folder;
    const std::string words = "compare --variants ga,bipop-cma-es --seeds 2 --budget 200*D --coco --out c ";
    REQUIRE(rugosa(words + "--problems bbob2-1,bbob5-1,bbob2-8", folder.path()).code == 0);
    const json result = result_in(folder / "c");
    for (const std::string variant : {"ga", "bipop-cma-es"}) {
        const auto in = folder / ("c/coco/" + variant);
        std::istringstream info(rough::read_whole(in / "bbobexp_f1.info"));
        for (const int dimension : {2, 5}) {
            std::string about, comment, runs;
            std::getline(info, about);
            std::getline(info, comment);
            std::getline(info, runs);
            const std::string D = std::to_string(dimension);
            CHECK(about == "funcId = 1, DIM = " + D + ", Precision = 1.000e-08, algId = '" + variant + "'");
            CHECK_THAT(comment, Catch::StartsWith("%"));
            CHECK_THAT(runs, Catch::StartsWith("data_f1/bbobexp_f1_DIM" + D + ".dat, 1:"));
            const json& told = result["problems"]["bbob" + D + "-1"]["variants"][variant]["runs"];
            std::istringstream rows(rough::read_whole(in / ("data_f1/bbobexp_f1_DIM" + D + ".dat")));
            int run = -1;
            long before = 0;
            double best = HUGE_VAL;
            for (std::string row; std::getline(rows, row);) {
                if (row[0] == '%') {
                    ++run, before = 0, best = HUGE_VAL;
                    continue;
                }
                std::istringstream cells(row);
                long evaluations = 0;
                double first = 0, second = 0;
                REQUIRE(cells >> evaluations >> first >> second);
                CHECK(evaluations > before);
                CHECK(second <= best);
                before = evaluations, best = second;
                CHECK(evaluations <= told[static_cast<std::size_t>(run)]["evaluations"].get<long>());
            }
            CHECK(run == 1);
            CHECK(before == told[1]["evaluations"].get<long>());
        }
        CHECK(std::filesystem::exists(in / "data_f8/bbobexp_f8_DIM2.tdat"));
    }
}
