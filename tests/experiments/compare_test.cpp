#include "apps/experiments/experiment.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "tests/apps/results.hpp"

#include <map>

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
        for (const json& run : variant["runs"]) CHECK(run["evaluations"] <= 300);
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
    CHECK_THAT(rough::read_whole(folder / "t1/report.html"), Catch::Contains("<svg"));
}

TEST_CASE("variants given by flag or by file run in the place of the usual ones") {
    const Folder folder;
    // A comma within brackets parts nothing: it is `union` that is not known.
    check_refused(rugosa("compare --problems bbob5-1 --seeds 2 --budget 500 --variants \"ga, mine=sample 9 | "
                         "pair(score, score, union) | best 1\" --out r",
                         folder.path()),
                  "union");
    folder.write("c.ini", "[experiment]\nkind = compare\n[compare]\nproblems = tsp14\nseeds = 2\nbudget = 300\n"
                          "[tours]\nmine = sample 9 | score | best 1\nga = ga\n");
    done(folder, "compare c.ini --budget 400 --out c");
    done(folder, "run c.ini --pictures off --out d");
    const json result = result_in(folder / "c")["problems"]["tsp14"];
    CHECK(result["variants"].size() == 2);
    CHECK(result["variants"].count("mine") == 1);
    CHECK(result["budget"] == 400);
    CHECK(result_in(folder / "d")["problems"]["tsp14"]["budget"] == 300);
}

TEST_CASE("the roughness problem is compared by the price of curves, with similarity for precision") {
    const Folder folder;
    const json result =
        result_of(folder, "compare --problems roughness --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' "
                          "--max-pressure 1.6e-4 --seeds 2 --curves 60 --variants plain,\"mine=sample 20 | score | "
                          "best 1\"")["problems"]["roughness"];
    for (const auto& [name, variant] : result["variants"].items())
        for (const json& run : variant["runs"]) {
            CHECK(run["evaluations"] <= 60);
            CHECK(run["precision"] > 0);
            CHECK(run["precision"] < 1);
        }
    CHECK(result["variants"]["mine"]["price"] == 20);
    CHECK(result["variants"]["mine"]["runs"][0]["evaluations"] == 20);
}

TEST_CASE("searches are compared by verified similarity on each target and grid") {
    const Folder folder;
    const json result =
        result_of(folder, "run '" RUGOSA_SOURCE "/experiments/compare/surface.ini' --set compare.curves=120 "
                          "--set 'model.nodes=16x16, 32' --set model.steps=6 --set compare.shortest-wave=0.2 "
                          "--set compare.seeds=2 --set surfaces.cco=");
    const json &map = result["problems"]["roughness-drawn"], &profile = result["problems"]["roughness-drawn-32"];
    CHECK(map["nodes"] == json({16, 16}));
    CHECK(profile["nodes"] == 32);
    CHECK(profile["target"]["points"].size() == 20);
    for (const json& problem : {map, profile}) {
        REQUIRE(problem["variants"].size() == 2);
        for (const auto& [name, variant] : problem["variants"].items()) {
            INFO(problem["problem"] << " " << name);
            CHECK(variant["genome"]["series"].size() >= 1);
            CHECK(variant["similarity_worst"] < 1);
            CHECK(variant["median_lowest_interval"][0] <= variant["median_lowest"]);
            CHECK(variant["median_lowest"] <= variant["median_lowest_interval"][1]);
            // Algorithm 1 is paid for as a whole, also if the budget ends inside it.
            CHECK(variant["price"].get<double>() <= 120 + 20);
        }
    }
    CHECK(result["groups"]["roughness-drawn"]["standing"].size() == 2);
    const std::string page = rough::read_whole(folder / "r" / "report.html");
    CHECK_THAT(page, Catch::Contains("<image") && Catch::Contains("<svg") && !Catch::Contains("No picture"));
    // A variant's median precision never rises, and is within its interval.
    std::map<std::string, double> last;
    for (const auto& row : app::csv_rows(rough::read_whole(folder / "r" / "progress.csv"))) {
        if (row[0] != "roughness-drawn-32") continue;
        const double precision = std::stod(row[3]);
        CHECK(std::stod(row[4]) <= precision);
        CHECK(precision <= std::stod(row[5]));
        if (last.contains(row[1])) CHECK(precision <= last[row[1]]);
        last[row[1]] = precision;
    }
    REQUIRE(last.size() == 2);
    for (const auto& [name, precision] : last)
        CHECK(precision >= profile["variants"][name]["median_precision"].get<double>() - 1e-6);
}

TEST_CASE("a search that cannot work is refused before any run starts") {
    const Folder folder;
    const std::string race = "run '" RUGOSA_SOURCE "/experiments/compare/variants.ini' --set "
                             "compare.curves=1000000000 --out s --set ";
    for (const std::string pipeline : {"bets", "'score | elite 1'"})
        check_refused(rugosa(race + "surfaces.mine=" + pipeline, folder.path(), "timeout 200"), "surfaces.mine");
    const std::string drawn = RUGOSA_SOURCE "/experiments/targets/drawn.csv";
    check_refused(rugosa(race + "'compare.target=" + drawn + ", " + drawn + "'", folder.path()),
                  "given as a name twice");
    CHECK_FALSE(std::filesystem::exists(folder / "s"));
}

TEST_CASE("names of files, folders and pipelines may have bytes that are not UTF-8") {
    const Folder folder;
    folder.write("t\xE9.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-6,0.1\n5e-6,0.12\n1e-5,0.14\n");
    folder.write("e\xE9.ini", "[experiment]\nkind = compare\n[compare]\nproblems = roughness\nseeds = 1\n"
                              "curves = 20\ntarget = t\xE9.csv\n[model]\nnodes = 32, 48\n"
                              "[surfaces]\nw\xE9 = sample 4 | score | best 1\n");
    done(folder, "run e\xE9.ini --pictures off --out r\xE9");
    CHECK(result_in(folder / "r\xE9")["problems"]["roughness-t\xEF\xBF\xBD"]["variants"].count("w\xEF\xBF\xBD") == 1);
}

TEST_CASE("runs on BBOB's functions are written as COCO has them, a folder for each variant") {
    const Folder folder;
    const json result = result_of(folder, "compare --variants ga,bipop-cma-es --seeds 2 --budget 200*D --coco "
                                          "--problems bbob2-1,bbob5-1,bbob2-8");
    for (const std::string variant : {"ga", "bipop-cma-es"}) {
        const auto in = folder / ("r/coco/" + variant);
        const std::string info = rough::read_whole(in / "bbobexp_f1.info");
        for (const std::string D : {"2", "5"}) {
            CHECK_THAT(info, Catch::Contains("funcId = 1, DIM = " + D + ", Precision = 1.000e-08, algId = '" + variant +
                                             "'\n%"));
            CHECK_THAT(info, Catch::Contains("\ndata_f1/bbobexp_f1_DIM" + D + ".dat, 1:"));
            std::istringstream rows(rough::read_whole(in / ("data_f1/bbobexp_f1_DIM" + D + ".dat")));
            std::vector<long> ends; // evaluations of each run
            double best = 0;
            for (std::string row; std::getline(rows, row);) {
                long evaluations = 0;
                double first = 0, second = 0;
                if (row[0] == '%') {
                    ends.push_back(0), best = HUGE_VAL;
                    continue;
                }
                std::istringstream cells(row);
                REQUIRE(cells >> evaluations >> first >> second);
                CHECK(evaluations > ends.back());
                CHECK(second <= best);
                ends.back() = evaluations, best = second;
            }
            const json& runs = result["problems"]["bbob" + D + "-1"]["variants"][variant]["runs"];
            CHECK(ends.size() == 2);
            CHECK(ends.back() == runs[1]["evaluations"].get<long>());
        }
        CHECK(std::filesystem::exists(in / "data_f8/bbobexp_f8_DIM2.tdat"));
    }
}

TEST_CASE("a number of nodes beyond every whole number is refused") {
    const Folder folder;
    folder.write("many.ini", "[experiment]\nkind = compare\n[model]\nnodes = 1e22\n");
    const auto settings = app::read_ini(folder / "many.ini", app::experiment_named("compare").all_settings());
    CHECK_THROWS_WITH(app::model_from(settings, "model."), Catch::Contains("1e22 is out of range"));
}
