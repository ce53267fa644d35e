#include "domain/mwm/genome_json.hpp"
#include "domain/paper/variants.hpp"
#include "domain/problem/problem.hpp"
#include "domain/target/similarity.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

/// Genomes of few, long waves on a fine grid, where coarser grids are worth a try.
const std::string paper = "run '" RUGOSA_SOURCE "/experiments/paper.ini' --pictures off --nodes 1025 "
                          "--set database.pairs=3 --set database.phase-columns=2 --set "
                          "database.shortest-wave=0.1 --set paper.sweep-points=0 ";

rough::Model model_of(const json& result) {
    rough::Model model;
    model.grid = {result["nodes"], result["length_mm"], false};
    model.body.datum = result["datum_mm"];
    model.loading = {result["steps"], result["reach"]};
    return model;
}

void check_account(const json& account, int nodes) {
    CHECK(account["accuracy"] == 0.01);
    CHECK(account["resolved_nodes"] == nodes);
    CHECK(account["estimated_error"] <= 0.01);
    CHECK(account["true_error"] <= 0.01);
    CHECK_THAT(account["words"].get<std::string>(), Catch::Contains("0.01 was asked for"));
}

} // namespace

TEST_CASE("an experiment within an accuracy says what it modelled, and its similarities are exact") {
    const Folder folder;
    const Ended ended = rugosa(paper + "--accuracy 0.01 --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json result = result_in(folder / "r/heldout");
    CHECK(result["accuracy"] == 0.01);
    CHECK(result["nodes"] == 1025);
    rough::Target target;
    target.x.resize(20), target.y.resize(20);
    for (rough::Index k = 0; k < 20; ++k) {
        target.x[k] = result["target"]["points"][static_cast<std::size_t>(k)]["pressure_MPa"];
        target.y[k] = result["target"]["points"][static_cast<std::size_t>(k)]["stiffness_MPa_per_mm"];
    }
    bool coarser = false;
    for (const auto& [name, variant] : result["variants"].items()) {
        INFO(name);
        const auto genome = rough::genome_from_json(variant["genome"], name);
        CHECK(similarity(target, secant_stiffness(respond(genome, model_of(result)))) ==
              Approx(variant["similarity"].get<double>()).margin(1e-9));
        check_account(variant["modelled"][0], 1025);
        coarser = coarser || variant["modelled"][0]["extrapolated"];
    }
    CHECK(coarser);
}

TEST_CASE("a design within an accuracy says what it modelled, and its similarities are exact") {
    const Folder folder;
    const std::string words = "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --pictures "
                              "off --nodes 1025 --shortest-wave 0.1 --max-pressure 1.6e-4 --pipeline "
                              "'sample 8 | score | best 2 | refine lm 3 | score verified | best 1' ";
    const Ended ended = rugosa(words + "--accuracy 0.01 --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code != 2);
    const json result = result_in(folder / "r");
    const json& variant = result["variants"]["pipeline"];
    const auto genome = rough::genome_from_json(variant["genome"], "genome");
    rough::DesignSetup setup;
    setup.model = model_of(result);
    setup.targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    setup.max_pressure = 1.6e-4;
    CHECK(similarity(setup, genome) == Approx(variant["similarity"].get<double>()).margin(1e-9));
    CHECK(similarity(setup, genome, 4) == Approx(variant["similarity_refined"].get<double>()).margin(1e-9));
    check_account(variant["modelled"][0], 1025);

    const int code = rugosa(words + "--out exact", folder.path()).code;
    REQUIRE((code == 0 || code == 3)); // so short a search may miss 0.99
    const json exact = result_in(folder / "exact");
    CHECK(exact["accuracy"].is_null());
    CHECK(exact["variants"]["pipeline"]["modelled"][0]["true_error"] == 0);
    CHECK(exact["variants"]["pipeline"]["modelled"][0]["grids"] == json{1025});
}

TEST_CASE("an accuracy that is none is refused where it was given") {
    const Folder folder;
    const Ended flag = rugosa(
        "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --accuracy 2", folder.path());
    CHECK(flag.code == 2);
    CHECK_THAT(flag.err, Catch::Contains("--accuracy"));
    check_refused(
        rugosa("run '" RUGOSA_SOURCE "/experiments/paper.ini' --set model.accuracy=none", folder.path()),
        "model.accuracy");
}
