#include "domain/design/tolerance.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/target/target.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string drawn =
    "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 65 --force --out r "
    "--pipeline 'shape 6 | score | best 2 | refine lm 8 | best 1'";

} // namespace

TEST_CASE("the tolerance of a design follows from its genome") {
    const Folder folder;
    const Ended ended =
        rugosa(drawn + " --pictures off --seed 3 --noise-length 0.05 --reach-similarity 0.8", folder.path());
    INFO(ended.err << ended.out);
    REQUIRE(ended.code != 2);
    const json result = result_in(folder / "r"), variant = result["variants"]["pipeline"];
    rough::DesignSetup setup;
    setup.model.grid = {65, result["length_mm"], false};
    setup.model.loading.steps = result["steps"];
    setup.required_similarity = 0.8;
    setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.errors.noise_length = 0.05;
    const rough::Tolerance expected =
        tolerance_of(setup, rough::genome_from_json(variant["genome"], "genome"), {.seed = 3});
    const json& tolerance = variant["tolerance"];
    CHECK(tolerance["noise_length_mm"] == 0.05);
    CHECK(tolerance["share"] == 0.95);
    CHECK(tolerance["draws"] == 1000);
    REQUIRE(tolerance["levels"].size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        const json& level = tolerance["levels"][i];
        CHECK(level["similarity"] == expected.levels[i].similarity);
        CHECK(level["noise_rms_mm"] == expected.levels[i].noise_rms);
        CHECK(level["tilt_mm"] == expected.levels[i].tilt);
        CHECK(level["scale"] == expected.levels[i].scale);
    }
    CHECK(tolerance["levels"][3]["noise_rms_mm"] > 0);
    CHECK_THAT(ended.out, Catch::Contains("Machine: for 0.") && Catch::Contains("µm correlation"));
    CHECK(rough::read_whole(folder / "r/tolerance.csv").starts_with("noise_rms_mm,quantile,median,draws\n"));
}

TEST_CASE("a design without a limit does not promise that it can be made") {
    const Folder folder;
    REQUIRE(rugosa(drawn + " --pictures off", folder.path()).code != 2);
    CHECK_THAT(result_in(folder / "r")["summary"]["making"].get<std::string>(),
               Catch::StartsWith("not known, as no limit was given") && Catch::Contains("--max-slope"));
    CHECK(result_in(folder / "r")["limits_given"] == false);
    REQUIRE(rugosa(drawn + " --pictures off --max-slope 1", folder.path()).code != 2);
    CHECK_THAT(result_in(folder / "r")["summary"]["making"].get<std::string>(), Catch::StartsWith("yes, by"));
}

TEST_CASE("a report is written when the time is spent") {
    const Folder folder;
    const Ended ended = rugosa(drawn + " --seconds 1e-3", folder.path());
    INFO(ended.err << ended.out);
    CHECK(ended.code == 3);
    CHECK_THAT(ended.out, Catch::Contains("Machine: "));
    CHECK_THAT(rough::read_whole(folder / "r/report.html"),
               Catch::Contains("not all is known") && Catch::Contains("Requested and found"));
}

TEST_CASE("a noise length or tilt out of range is refused") {
    const Folder folder;
    for (const char* flag : {"--noise-length 0.001", "--noise-length 1", "--tilt 0", "--noise -1"}) {
        const Ended ended = rugosa(drawn + " " + flag, folder.path());
        INFO(flag << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK_THAT(ended.err, Catch::Contains(std::string(flag).substr(2, 4)));
    }
}
