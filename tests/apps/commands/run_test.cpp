#include "domain/mwm/genome_json.hpp"
#include "domain/paper/variants.hpp"
#include "domain/target/similarity.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string paper = "run '" RUGOSA_SOURCE "/experiments/paper.ini'";
const std::string coarse =
    " --pictures off --set model.nodes=64 --set database.pairs=6 --set paper.sweep-points=2";

} // namespace

TEST_CASE("the paper's experiment gives six variants on both targets, each similarity to be computed again") {
    const Folder folder;
    const Ended ended = rugosa(paper + coarse + " --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    for (const char* place : {"r", "r/heldout"}) {
        const json result = result_in(folder / place);
        const std::string curves = rough::read_whole(folder / place / "curves.csv");
        CHECK(std::count(curves.begin(), curves.end(), '\n') ==
              1 + result["steps"].get<long>() * static_cast<long>(result["variants"].size()));
        CHECK(rows_of(folder / place / "scores.csv", "id,similarity,similarity_low,similarity_high").size() ==
              30); // five genomes of each of the six pairs
        std::set<std::string> names;
        for (const auto& [name, variant] : result["variants"].items())
            names.insert(name);
        CHECK(names ==
              std::set<std::string>{"sog", "gco", "cco", "sog-minimax", "gco-minimax", "cco-minimax"});

        rough::Model model;
        model.grid = {result["nodes"], result["length_mm"], false};
        model.body.datum = result["datum_mm"];
        model.loading = {result["steps"], result["reach"]};
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
            // The amplitude is in final form: no rescaling is needed on the run's own grid.
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

TEST_CASE("the same seed gives the same result on 1, 2 and 5 threads") {
    const Folder folder;
    REQUIRE(rugosa(paper + coarse + " --threads 1 --out t1", folder.path()).code == 0);
    for (const char* threads : {"2", "5"}) {
        const std::string out = std::string("t") + threads;
        REQUIRE(rugosa(paper + coarse + " --threads " + threads + " --out " + out, folder.path()).code == 0);
        CHECK(timeless(result_in(folder / out)) == timeless(result_in(folder / "t1")));
        CHECK(timeless(result_in(folder / (out + "/heldout"))) == timeless(result_in(folder / "t1/heldout")));
    }
}

TEST_CASE("a measured profile can be the target") {
    const Folder folder;
    std::string scan;
    for (int i = 0; i < 150; ++i)
        scan += std::to_string(i * 0.7) + " " + std::to_string(std::sin(0.21 * i) + 0.3 * std::sin(0.9 * i)) +
                "\n";
    folder.write("scan.txt", scan);
    const Ended ended =
        rugosa(paper + coarse + " --set target.profile=scan.txt --set target.unit=um --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json result = result_in(folder / "r");
    CHECK(result["length_mm"].get<double>() == Approx(149 * 0.7e-3));
    CHECK(result["datum_mm"] == result["length_mm"]);
    CHECK_FALSE(std::filesystem::exists(folder / "r/heldout"));
}

TEST_CASE("an experiment's own variants, written as text, run beside the paper's") {
    const Folder folder;
    const std::string own =
        " --set paper.sweep-points=0 --set 'variants.mine=score | best 6 | repeat 2 { tournament 2 "
        "| cross uniform | mutate 0.1 | score | refine lm 5 | elite 2 } | best 1'"
        " --set 'variants.more=mine | refine minimax 3'";
    const Ended ended = rugosa(paper + coarse + own + " --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json variants = result_in(folder / "r")["variants"];
    CHECK(variants.size() == 8);
    CHECK(variants["more"]["similarity"] >= variants["mine"]["similarity"]);
    CHECK(variants["mine"]["stages"][2]["path"] == "mine/repeat.1/tournament.1");

    const Ended misspelt =
        rugosa(paper + coarse + " --set 'variants.mine=score | bset 3' --out m", folder.path());
    CHECK(misspelt.code == 2);
    CHECK(misspelt.error_lines() == 1);
    CHECK_THAT(misspelt.err, Catch::Contains("column 9") && Catch::Contains("best"));
    const Ended taken = rugosa(paper + coarse + " --set 'variants.sog=score' --out m", folder.path());
    CHECK(taken.code == 2);
}

TEST_CASE("an experiment killed at any moment goes on to the very result of an uninterrupted one") {
    const Folder folder;
    const std::string words =
        paper + coarse + " --set paper.sweep-points=0 --set database.pairs=20 --threads 1";
    const Ended unbroken = rugosa(words + " --out whole", folder.path());
    REQUIRE(unbroken.code == 0);
    const json whole = timeless(result_in(folder / "whole"));
    for (const double share : {0.2, 0.5, 0.8}) {
        const std::string out = "killed" + std::to_string(share);
        rugosa_killed(share * unbroken.seconds, words + " --out " + out, folder.path());
        const Ended ended = rugosa(words + " --out " + out + " --resume", folder.path());
        INFO(ended.err);
        REQUIRE(ended.code == 0);
        CHECK(timeless(result_in(folder / out)) == whole);
        CHECK(std::filesystem::exists(folder / (out + "/log/drawn-gco.csv")));
    }
}

TEST_CASE("an experiment that was interrupted says so, leaves its tables, and goes on to the very result") {
    const Folder folder;
    const std::string words =
        paper + coarse +
        " --set paper.sweep-points=0 --set 'variants.long=score | best 5 | repeat 300 { "
        "tournament 2 | cross uniform | mutate 0.1 | score | elite 2 }' --threads 1";
    const Ended unbroken = rugosa(words + " --out whole", folder.path());
    REQUIRE(unbroken.code == 0);
    int interrupted = 0;
    for (const double share : {0.3, 0.6, 0.9}) {
        const std::string out = "cut" + std::to_string(share);
        const Ended cut =
            rugosa(words + " --out " + out, folder.path(),
                   "timeout --preserve-status -s INT " + std::to_string(share * unbroken.seconds));
        interrupted += cut.code == 130;
        const Ended ended = rugosa(words + " --out " + out + " --resume", folder.path());
        INFO(cut.err << ended.err);
        REQUIRE(ended.code == 0);
        CHECK(timeless(result_in(folder / out)) == timeless(result_in(folder / "whole")));
    }
    CHECK(interrupted > 0);
}

TEST_CASE("without --out a run finds a free folder, and a result is not written over unasked") {
    const Folder folder;
    const std::string quick = paper + coarse + " --set paper.sweep-points=0";
    REQUIRE(rugosa(quick, folder.path()).code == 0);
    REQUIRE(rugosa(quick, folder.path()).code == 0);
    CHECK(std::filesystem::exists(folder / "out/paper/result.json"));
    CHECK(std::filesystem::exists(folder / "out/paper-2/result.json"));
    const Ended again = rugosa(quick + " --out out/paper", folder.path());
    CHECK(again.code == 2);
    CHECK_THAT(again.err, Catch::Contains("--force"));
    CHECK(rugosa(quick + " --out out/paper --force", folder.path()).code == 0);
}

TEST_CASE("chart and stability are experiments too, and their files are those of their short names") {
    const Folder folder;
    const std::string spike = " --set stability.scene=spike";
    const Ended ended =
        rugosa("run '" RUGOSA_SOURCE "/experiments/stability.ini'" + spike + " --pictures off --out s",
               folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(std::filesystem::exists(folder / "s/stability.csv"));
    CHECK_FALSE(std::filesystem::exists(folder / "s/report.html"));
    const json result = result_in(folder / "s");
    REQUIRE(result["runs"].size() == 15); // three kernels, five methods
    for (const json& row : result["runs"])
        CHECK(row["scene"] == "spike");
    REQUIRE(rugosa("run '" RUGOSA_SOURCE "/experiments/chart.ini' --set chart.quick=on --set "
                   "chart.minutes=1e-9 --out c",
                   folder.path())
                .code == 0);
    CHECK(std::filesystem::exists(folder / "c/chart.csv"));
    CHECK(std::filesystem::exists(folder / "c/report.html"));
}

TEST_CASE("bad input to an experiment gets one line and exit code 2, and leaves no folder") {
    const Folder folder;
    const auto target_of = [&](const std::string& name, const std::string& points) {
        return " --set target.file=" +
               folder.write(name, "pressure_MPa,stiffness_MPa_per_mm\n" + points).filename().string();
    };
    folder.write("scan.txt", "0 1\n1 2\n2 x\n");
    folder.write("unknown.ini", "[model]\nnodez = 512\n");
    folder.write("section.ini", "[modle]\nnodes = 512\n");
    folder.write("broken.ini", "[model\nnodes 512\n");
    folder.write("twice.ini", "[model]\nnodes = 512\nnodes = 256\n");
    folder.write("kind.ini", "[experiment]\n\nkind = chrat\n");
    folder.write("other.ini", "[experiment]\nkind = stability\n[chart]\nminutes = 3\n");
    folder.write("file", "");
    const std::vector<std::pair<std::string, std::string>> cases{
        {"run", "no experiment given"},
        {"run missing.ini", "missing.ini: cannot be read"},
        {"run unknown.ini", "unknown.ini:2: unknown key 'model.nodez'; did you mean 'model.nodes'?"},
        {"run section.ini", "section.ini:2: unknown key 'modle.nodes'"},
        {"run broken.ini", "broken.ini"},
        {"run twice.ini", "model.nodes: given twice"},
        {"run kind.ini", "kind.ini:3: experiment.kind: \"chrat\" given; did you mean 'chart'?"},
        {"run other.ini", "other.ini:4: unknown key 'chart.minutes'"},
        {"run other.ini --set chart.minutes= --nodes 64", "unknown key"},
        {"run '" RUGOSA_SOURCE "/experiments/chart.ini' --resume --out file", "keeps no checkpoints"},
        {"chart --minutes -1", "--minutes: -1 given"},
        {paper + " --set nodes", "--set"},
        {paper + " --set model.nodez=5", "did you mean"},
        {paper + " --set model.nodes=1", "model.nodes: 1 given"},
        {paper + " --set model.nodes=1e8", "model.nodes: 1e8 given"},
        {paper + " --set model.steps=1", "model.steps: 1 given"},
        {paper + " --set model.datum=0.2", "0.21"},
        {paper + " --set database.gamma-from=1", "database.gamma-from"},
        {paper + " --set database.A=0", "database.A: 0 given"},
        {paper + " --set paper.max-pressure=1e-5", "expected at most max-pressure"},
        {paper + " --set paper.threshold=0", "low part"},
        {paper + " --set paper.threshold=1", "high part"},
        {paper + " --seed x", "experiment.seed"},
        {paper + " --set target.file=none.csv", "none.csv: cannot be read"},
        {paper + target_of("zero.csv", "0,1\n1e-5,1\n"), "point 1: pressure_MPa is 0"},
        {paper + target_of("negative.csv", "1e-5,-1\n"), "point 1: stiffness_MPa_per_mm is -1"},
        {paper + target_of("nan.csv", "1e-5,nan\n"), "\"nan\" given, expected a finite number"},
        {paper + target_of("unsorted.csv", "2e-5,1\n1e-5,1\n"), "point 2: pressure"},
        {paper + target_of("duplicate.csv", "1e-5,1\n1e-5,1\n"), "point 2: pressure"},
        {paper + target_of("word.csv", "1e-5,abc\n"), "word.csv:2"},
        {paper + target_of("empty.csv", ""), "no points given"},
        {paper + " --set target.profile=scan.txt", "scan.txt, line 3"},
        {paper + " --out file", "--out"},
        {paper + " --out file/below", "--out"},
    };
    const auto files = folder.names().size();
    for (const auto& [words, expected] : cases) {
        const Ended ended = rugosa(words, folder.path());
        INFO(words << "\n" << ended.err);
        check_refused(ended, expected);
        CHECK(folder.names().size() == files);
    }
}
