#include "tests/apps/results.hpp"

using namespace app::testing;

TEST_CASE("a design without heights writes parameters, curves and surfaces that the program reads") {
    const Folder folder;
    const std::string run = "run '" RUGOSA_SOURCE "/experiments/statistical.ini' --set "
                            "statistical.nodes=64 --set statistical.realisations=1 --set "
                            "'statistical.pipeline=sample 60 | score | best 1' --out r";
    const Ended ended = rugosa(run, folder.path());
    const auto result = result_of(ended, folder / "r");
    CHECK_THAT(ended.out, Catch::StartsWith("r: similarity ") && Catch::EndsWith(" s\n"));
    CHECK(result["similarity"].get<double>() > 0.5);
    CHECK(result["evaluations"] == 60);
    CHECK(result["parameters"]["longest_mm"] > result["parameters"]["shortest_mm"]);
    CHECK(result["similarity_realised"].size() == 1);
    CHECK(result["curves"].size() == 15);
    CHECK_THAT(rough::read_whole(folder / "r/report.html"),
               Catch::Contains("<svg") && !Catch::Contains("No picture"));
    done(folder, "profile --surface r/surface-1.x3p --periodic --pictures off --detrend none --out p");
}
