#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string words =
    "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 128 --threads 1 --pictures off "
    "--max-slope 0.5 --pipeline 'shape 12 | score | best 4 | refine lm 6 | repeat 12 { tournament 2 | "
    "cross uniform | mutate 0.1 | score | refine lm 6 | elite 1 } | best 2 | score verified'";

} // namespace

TEST_CASE("a design out of time goes on where it stopped, and a set-up that is another is refused") {
    const Folder folder;
    const Ended whole = rugosa(words + " --out whole", folder.path());
    REQUIRE(whole.code != 2);
    // However fast the machine has become since, a short enough time cuts it.
    bool unfinished = false;
    for (double seconds = whole.seconds; !unfinished && seconds > 1e-3;) {
        seconds /= 2;
        const Ended cut =
            rugosa(words + " --force --out cut --seconds " + std::to_string(seconds), folder.path());
        REQUIRE(cut.code != 2);
        unfinished = cut.out.find("--resume") != std::string::npos;
    }
    REQUIRE(unfinished);
    check_refused(rugosa(words + " --max-height 1 --out cut --resume", folder.path()), "checkpoint");
    const Ended homeless = rugosa(words + " --resume", folder.path());
    CHECK(homeless.code == 2);
    CHECK_THAT(homeless.err, Catch::Contains("--out"));
    REQUIRE(rugosa(words + " --out cut --resume", folder.path()).code != 2);
    CHECK(timeless(result_in(folder / "cut")) == timeless(result_in(folder / "whole")));
}
