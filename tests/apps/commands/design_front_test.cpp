#include "domain/design/front.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

/// Stiffness and contact area that no one surface has: those of two different ones.
std::string two_targets(const Folder& folder) {
    folder.write("a.json", R"({"series":[{"A":1,"H":0.8,"gamma":1.5,"lambda":0.84942,"chromosomes":
        [{"n":1,"phases":[0.3]},{"n":2,"phases":[2]},{"n":3,"phases":[4]}]}]})");
    folder.write("b.json", R"({"series":[{"A":1,"H":1.2,"gamma":1.5,"lambda":0.84942,"chromosomes":
        [{"n":1,"phases":[3.0]},{"n":2,"phases":[1]}]}]})");
    REQUIRE(rugosa("target --genome a.json --nodes 128 --to 1e-2 --out K.csv", folder.path()).code == 0);
    REQUIRE(rugosa("target --genome b.json --nodes 128 --to 1e-2 --quantity area --out A.csv", folder.path())
                .code == 0);
    return "design --target K.csv,A.csv --nodes 128 ";
}

} // namespace

TEST_CASE("two targets give a front whose similarities follow from its genomes, with a picture") {
    const Folder folder;
    const Ended ended = rugosa(
        two_targets(folder) +
            "--pipeline 'shape 12 | score | refine lm 3 | pareto goal1 goal2 | repeat 2 { tournament 2 "
            "| cross uniform | mutate 0.1 | parents | pareto goal1 goal2 | best 12 } | front' --out r",
        folder.path());
    INFO(ended.out << ended.err);
    REQUIRE(ended.code != 2);
    const json result = result_in(folder / "r");
    const json& front = result["variants"]["pipeline"]["front"];
    REQUIRE(front.size() > 1);
    rough::DesignSetup setup;
    setup.model.grid = {128, 0.84942, false};
    setup.targets = {rough::read_target(folder / "K.csv"), rough::read_target(folder / "A.csv")};
    double best = -HUGE_VAL;
    for (const json& one : front) {
        const rough::Genome genome = rough::genome_from_json(one["genome"], "genome");
        for (const auto& [name, refine] : {std::pair("similarity", 1), std::pair("similarity_refined", 4)}) {
            const auto each =
                similarities(setup, respond(setup, genome, rough::refined(setup.model, refine)));
            for (std::size_t g = 0; g < 2; ++g)
                CHECK(one[name][g].get<double>() == Approx(each[g]).margin(1e-9));
        }
        best =
            std::max(best, std::min({one["similarity"][0].get<double>(), one["similarity"][1].get<double>(),
                                     one["similarity_refined"][0].get<double>(),
                                     one["similarity_refined"][1].get<double>()}));
    }
    const json& variant = result["variants"]["pipeline"];
    CHECK(std::min(variant["similarity"].get<double>(), variant["similarity_refined"].get<double>()) >=
          best - 0.05);
    CHECK_THAT(rough::read_whole(folder / "r/report.html"),
               Catch::Contains("What the targets cost each other"));
}

TEST_CASE("the two-target variants answer by name, and are refused with one target in a line that says why") {
    const Folder folder;
    const std::string words = two_targets(folder) + "--pictures off --seconds 4 --variant ";
    for (const std::string variant : {"mcco", "nsga2"}) {
        const Ended ended = rugosa(words + variant + " --out " + variant, folder.path());
        INFO(ended.out << ended.err);
        REQUIRE(ended.code != 2);
        const json result = result_in(folder / variant);
        CHECK(result["variants"][variant]["genome"]["series"].size() >= 1);
        CHECK(result["targets"].size() == 2);
        check_refused(
            rugosa("design --target K.csv --nodes 128 --out one --variant " + variant, folder.path()),
            "goal2");
    }
}

TEST_CASE("the operators listed are those that a design takes, with its variants by name") {
    const Ended ended = rugosa("operators");
    REQUIRE(ended.code == 0);
    for (const char* word : {"shape n", "\n  reduce goal2 ", "  fit ", "default = pass", "mcco = pair",
                             "nsga2 = ", "macro", "sog-minimax = "})
        CHECK_THAT(ended.out, Catch::Contains(word));
}
