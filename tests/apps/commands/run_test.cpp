#include "domain/paper/variants.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string paper = "run '" RUGOSA_SOURCE "/experiments/paper/paper.ini'";
const std::string coarse = " --pictures off --set model.nodes=64 --set database.pairs=6 --set paper.sweep-points=2";

} // namespace

TEST_CASE("the paper's experiment gives six variants on both targets, with similarities that can be recomputed") {
    const Folder folder;
    done(folder, paper + coarse + " --out r");
    for (const char* place : {"r", "r/heldout"}) {
        const json result = result_in(folder / place);
        const std::string curves = rough::read_whole(folder / place / "curves.csv");
        CHECK(std::ranges::count(curves, '\n') ==
              1 + result["steps"].get<long>() * static_cast<long>(result["variants"].size()));
        CHECK(rows_of(folder / place / "scores.csv", "id,similarity,similarity_low,similarity_high").size() ==
              30); // five genomes of each of the six pairs
        std::set<std::string> names;
        for (const auto& [name, variant] : result["variants"].items()) names.insert(name);
        CHECK(names == std::set<std::string>{"sog", "gco", "cco", "sog-minimax", "gco-minimax", "cco-minimax"});

        rough::Model model;
        model.grid = {result["nodes"], result["length_mm"], false};
        model.body.datum = result["datum_mm"].get<double>();
        model.loading = {result["steps"], result["reach"].get<double>()};
        rough::Target target;
        target.x.resize(20), target.y.resize(20);
        for (rough::Index k = 0; k < 20; ++k) {
            const json& point = result["target"]["points"][static_cast<std::size_t>(k)];
            target.x[k] = point["pressure_MPa"];
            target.y[k] = point["stiffness_MPa_per_mm"];
        }
        for (const auto& [name, variant] : result["variants"].items()) {
            INFO(place << " " << name);
            const auto genome = rough::genome_from_json(variant["genome"], name);
            // The amplitude is final: no rescaling is needed on the grid of the run.
            CHECK(similarity(target, secant_stiffness(respond(genome, model))) ==
                  Approx(variant["similarity"].get<double>()).margin(1e-9));
            const auto setup = rough::paper_setup(model, target, result["max_pressure_MPa"], 8e-5);
            CHECK(similarity(as_reported(setup), genome, 4) ==
                  Approx(variant["similarity_refined"].get<double>()).margin(1e-9));
            CHECK(variant["stages"].back()["candidates"].size() == 1);
            CHECK(variant["curves"].get<int>() >= 30);
        }
    }
}

TEST_CASE("a run gives one result on 1, 2 and 5 threads") {
    const Folder folder;
    done(folder, paper + coarse + " --threads 1 --out t1");
    for (const char* threads : {"2", "5"}) {
        const std::string out = std::string("t") + threads;
        done(folder, paper + coarse + " --threads " + threads + " --out " + out);
        CHECK(timeless(result_in(folder / out)) == timeless(result_in(folder / "t1")));
        CHECK(timeless(result_in(folder / (out + "/heldout"))) == timeless(result_in(folder / "t1/heldout")));
    }
}

TEST_CASE("variants of an experiment, written as text, run with the paper's") {
    const Folder folder;
    const std::string own = " --set paper.sweep-points=0 --set 'variants.mine=score | best 6 | repeat 2 { tournament 2 "
                            "| cross uniform | mutate 0.1 | score | refine lm 5 | elite 2 } | best 1'"
                            " --set 'variants.more=mine | refine minimax 3'";
    const json variants = result_of(folder, paper + coarse + own)["variants"];
    CHECK(variants.size() == 8);
    CHECK(variants["more"]["similarity"] >= variants["mine"]["similarity"]);
    CHECK(variants["mine"]["stages"][2]["path"] == "mine/repeat.1/tournament.1");
}

TEST_CASE("a paper's run refuses a variant that draws genomes before it computes") {
    const Folder folder;
    for (const char* text : {"sample 40 | score | best 1", "score | repeat 2 { sample 4 sobol | score } | best 1"})
        check_refused(rugosa(paper + " --pictures off --set 'variants.mine=" + text + "'", folder.path()),
                      "variants.mine: stage 'sample 4");
}

TEST_CASE("a run without --out finds a free folder, and keeps an existing result") {
    const Folder folder;
    const std::string quick = paper + coarse + " --set paper.sweep-points=0";
    done(folder, quick);
    done(folder, quick);
    CHECK(std::filesystem::exists(folder / "out/paper/result.json"));
    CHECK(std::filesystem::exists(folder / "out/paper-2/result.json"));
    check_refused(rugosa(quick + " --out out/paper", folder.path()), "--force");
    done(folder, quick + " --out out/paper --force");
}
