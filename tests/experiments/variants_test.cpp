#include "apps/report/csv.hpp"
#include "tests/apps/results.hpp"

#include <map>

using namespace app::testing;
using nlohmann::json;

TEST_CASE("pipelines are compared on the same targets with the same budget and seeds") {
    const Folder folder;
    done(folder, "run '" RUGOSA_SOURCE
                 "/experiments/compare/variants.ini' --pictures off --set experiment.budget=150 --set "
                 "experiment.seeds=2 --set model.nodes=64 --set targets.shortest-wave=0.06 --out r");
    for (const char* place : {"r", "r/heldout"}) {
        const json result = result_in(folder / place);
        CHECK(result["variants"].size() == 9);
        for (const auto& [name, variant] : result["variants"].items()) {
            INFO(place << " " << name);
            REQUIRE(variant["runs"].size() == 2);
            CHECK(variant["runs"][0]["seed"] == 1);
            CHECK(variant["genome"]["series"].size() >= 1);
            if (name != "cco") // the curves of Algorithm 1 do not count
                CHECK(variant["curves"].get<long>() + variant["gradients"].get<long>() <= 160);
            CHECK(variant["similarity"].get<double>() <= 1);
        }
    }
    const std::string table = rough::read_whole(folder / "r" / "variants.csv");
    CHECK(table.starts_with("target,variant,seed,curves_and_gradients,seconds,similarity\n"));
    CHECK(table.find("heldout,default,2,") != std::string::npos);
    // A shortfall is 1 less the best similarity by then, in the median over the seeds.
    int compared = 0;
    for (const auto& row : app::csv_rows(rough::read_whole(folder / "r" / "shortfall.csv")))
        if (row[0] == "drawn" && row[2] == "evaluations") {
            std::map<std::string, double> best; // best similarity for each seed
            for (const auto& one : app::csv_rows(table))
                if (one[0] == "drawn" && one[1] == row[1] && std::stod(one[3]) <= std::stod(row[3]))
                    best[one[2]] = std::stod(one[5]); // the last row is the best
            if (best.size() == 2) {
                const double shortfall = 1 - (best["1"] + best["2"]) / 2;
                CHECK(std::stod(row[4]) == Approx(std::max(1e-5, shortfall)).epsilon(1e-4));
                ++compared;
            }
        }
    CHECK(compared > 40);
}

TEST_CASE("a pipeline that cannot search is refused before any other one starts") {
    const Folder folder;
    const std::string long_race = "run '" RUGOSA_SOURCE "/experiments/compare/variants.ini' --set "
                                  "experiment.budget=1000000000 --out s --set variants.mine=";
    for (const std::string pipeline : {"bets", "'score | elite 1'"})
        check_refused(rugosa(long_race + pipeline, folder.path(), "timeout 200"), "variants.mine");
    CHECK_FALSE(std::filesystem::exists(folder / "s"));
}

TEST_CASE("the paper's algorithms run on maps and on profiles, and the page shows both", "[areas]") {
    const Folder folder;
    done(folder, "run '" RUGOSA_SOURCE "/experiments/compare/surface.ini' --set experiment.budget=120 --set "
                 "'model.nodes=16x16, 32' --set model.steps=6 --set targets.shortest-wave=0.2 "
                 "--set variants.cco= --out r");
    CHECK(result_in(folder / "r")["nodes"] == json({16, 16}));
    CHECK(result_in(folder / "r" / "drawn-32")["nodes"] == 32);
    const std::string page = rough::read_whole(folder / "r" / "report.html");
    CHECK_THAT(page, Catch::Contains("<image") && Catch::Contains("<svg") && !Catch::Contains("No picture"));
}

TEST_CASE("names of files, folders and pipelines may have bytes that are not UTF-8") {
    const Folder folder;
    folder.write("t\xE9.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-6,0.1\n5e-6,0.12\n1e-5,0.14\n");
    folder.write("e\xE9.ini",
                 "[experiment]\nkind = variants\nseeds = 1\nbudget = 20\n[targets]\nfiles = t\xE9.csv\n"
                 "[model]\nnodes = 32\n[variants]\nw\xE9 = sample 4 | score | best 1\n");
    done(folder, "run e\xE9.ini --pictures off --out r\xE9");
    CHECK(result_in(folder / "r\xE9")["variants"].count("w\xEF\xBF\xBD") == 1);
}
