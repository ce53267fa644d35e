#include "domain/design/search.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/problem/problem.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string drawn = "design --target '" RUGOSA_TEST_DATA "/target_paper.csv'";
const std::string pictured = " --pipeline 'shape 6 | score | best 2 | refine lm 8 | best 2'";
const std::string brief = " --pictures off" + pictured;

rough::DesignSetup setup_of(const json& result) {
    rough::DesignSetup setup;
    setup.model.grid = {result["nodes"], result["length_mm"], false};
    setup.model.body.datum = result["datum_mm"];
    setup.model.loading.steps = result["steps"];
    setup.model.contact.solver = rough::Solver::nested;
    setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    if (!result["max_pressure_MPa"].is_null())
        setup.max_pressure = result["max_pressure_MPa"].get<double>();
    return setup;
}

} // namespace

TEST_CASE("a design's similarities follow from its genome, amplitude free or by Eq. 11") {
    for (const char* mode : {" --max-pressure 1.6e-4", ""}) {
        const Folder folder;
        const bool free = std::string(mode).empty();
        const Ended ended = rugosa(drawn + mode + (free ? pictured : brief) + " --out r", folder.path());
        INFO(ended.err << ended.out);
        REQUIRE(ended.code != 2);
        const json result = result_in(folder / "r");
        const rough::DesignSetup setup = setup_of(result);
        const json& variant = result["variants"]["pipeline"];
        const rough::Genome genome = rough::genome_from_json(variant["genome"], "genome");
        CHECK(variant["similarity"].get<double>() == Approx(similarity(setup, genome)).margin(1e-9));
        CHECK(variant["similarity_refined"].get<double>() ==
              Approx(similarity(setup, genome, 4)).margin(1e-9));
        CHECK(variant["similarity_worst"].get<double>() ==
              Approx(rough::Verifier(as_reported(setup)).of(genome).worst()).margin(1e-9));
        CHECK(ended.code ==
              (variant["similarity_worst"].get<double>() >= rough::default_required_similarity ? 0 : 3));
        CHECK(variant["similarity"].get<double>() > 0.95);
        CHECK(variant["alternatives"].size() >= 1);
        CHECK(variant["trust"]["checks"].size() == 5);
        CHECK(variant["trust"]["tenth_percentile"] <= variant["trust"]["median"]);
        if (setup.max_pressure) // the amplitude is in final form: full approach is at p_max
            CHECK(respond(genome, setup.model).pressure.tail(1)[0] == Approx(1.6e-4).epsilon(1e-9));
        CHECK_THAT(variant["pipeline"].get<std::string>(), Catch::StartsWith("shape 6 | score"));
        const std::string page = free ? rough::read_whole(folder / "r/report.html") : "";
        for (const char* words :
             {"How much two profiles differ is 1 less the correlation coefficient",
              "at worst (the least of these and of both together)", "How precise the machine must be"})
            CHECK((!free || page.find(words) != std::string::npos));
        if (free) {
            CHECK(outline(page) == Outline{"table Not found", "table Tolerance", "figure goal-1", "# The answer",
                                           "table ", "table What can be made",
                                           "# How precise the machine must be", "figure figure-tolerance",
                                           "# Different answers", "figure profiles",
                                           "table ", "# How far to trust it", "table The same verified again",
                                           "table On other bodies, for comparison", "# How it was found"});
            CHECK(rugosa("report r --out again.html", folder.path()).code == 0);
            CHECK(rough::read_whole(folder / "again.html") == page);
        }
        const rough::Genome alone = rough::read_genome(folder / "r" / "genome.json");
        CHECK(rough::genes(alone) == rough::genes(genome));
    }
}

TEST_CASE("a design is the same for any number of threads and another for another seed") {
    const Folder folder;
    const std::string coarse =
        drawn + " --max-pressure 1.6e-4 --nodes 128 --pictures off --pipeline 'sample 12 | score "
                "| best 4 | refine lm 6 | repeat 2 { tournament 2 | cross uniform | mutate 0.1 | "
                "score | elite 1 }' --out ";
    REQUIRE(rugosa(coarse + "one --threads 1", folder.path()).code != 2);
    REQUIRE(rugosa(coarse + "three --threads 3", folder.path()).code != 2);
    REQUIRE(rugosa(coarse + "other --seed 2", folder.path()).code != 2);
    CHECK(timeless(result_in(folder / "one")) == timeless(result_in(folder / "three")));
    CHECK(result_in(folder / "one")["variants"] != result_in(folder / "other")["variants"]);
}

TEST_CASE("every named variant answers, on the database or on starts of its own") {
    const Folder folder;
    for (const char* variant : {"sog", "gco", "cco", "plain"}) {
        const Ended ended = rugosa(
            drawn + " --max-pressure 1.6e-4 --nodes 64 --shortest-wave 0.05 --pictures off --variant " +
                variant + " --seconds 20 --out " + variant,
            folder.path());
        INFO(variant << ": " << ended.err << ended.out);
        REQUIRE(ended.code != 2);
        const json result = result_in(folder / variant)["variants"][variant];
        CHECK(result["similarity"].get<double>() > 0.3);
        CHECK(result["stages"][0]["path"].get<std::string>().starts_with(std::string(variant) + "/"));
    }
}

TEST_CASE("limits on what can be made hold in the answer and are stated with their margins") {
    const Folder folder;
    REQUIRE(rugosa(drawn + brief + " --out r", folder.path()).code != 2);
    const json free = result_in(folder / "r")["variants"]["pipeline"]["margins"];
    const double slope = free[1]["value"], radius = free[3]["value"];
    const std::string limits = " --max-slope " + std::to_string(0.9 * slope) + " --min-radius " +
                               std::to_string(1.1 * radius) + " --shortest-wave 0.03";
    const Ended ended =
        rugosa(drawn + " --pictures off --pipeline 'shape 8 | score | refine lm 15 | best 2'" + limits +
                   " --out limited",
               folder.path());
    INFO(ended.err << ended.out);
    const json result = result_in(folder / "limited");
    const json& variant = result["variants"]["pipeline"];
    REQUIRE(ended.code != 2);
    CHECK(variant["within_limits"] == true);
    for (const json& margin : variant["margins"])
        if (!margin["limit"].is_null())
            CHECK(margin["margin"].get<double>() >= 0);
    const rough::Genome genome = rough::genome_from_json(variant["genome"], "genome");
    const rough::Profile finer = sample(genome, refined(setup_of(result).model.grid, 4));
    const rough::Index n = finer.nodes();
    const Eigen::VectorXd steepness = (finer.heights.tail(n - 1) - finer.heights.head(n - 1)) / finer.spacing;
    CHECK(steepness.cwiseAbs().maxCoeff() <= 0.9 * slope);
}

TEST_CASE("a target that no profile can reach is called so, with the pressures at fault") {
    const Folder folder;
    folder.write("falls.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-5,0.5\n5e-5,0.8\n1e-4,0.6\n");
    folder.write("stiff.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-5,0.5\n5e-5,0.8\n1e-4,3\n");
    for (const auto& [name, word, at] :
         {std::tuple("falls", "falls", 5e-5), std::tuple("stiff", "full contact", 1e-4)}) {
        const Ended ended =
            rugosa(std::string("design --target ") + name + ".csv --nodes 128" + brief + " --out " + name,
                   folder.path());
        CHECK(ended.code == 3);
        CHECK(ended.err.empty());
        const json result = result_in(folder / name);
        CHECK(result["verdict"].get<std::string>().find("out of reach") == 0);
        CHECK(result["verdict"].get<std::string>().find(word) != std::string::npos);
        CHECK(result["out_of_reach"][0]["at"][0].get<double>() == at);
        CHECK(result["variants"]["pipeline"]["similarity"].get<double>() <=
              result["out_of_reach"][0]["highest_similarity"].get<double>() + 1e-9);
    }
}

TEST_CASE("a similarity that was asked for and missed ends with 3, and what was found is written") {
    const Folder folder;
    const Ended ended = rugosa(drawn + " --nodes 64 --pictures off --pipeline 'sample 4 | score | best 1' "
                                       "--reach-similarity 0.9999 --out r",
                               folder.path());
    CHECK(ended.code == 3);
    CHECK(ended.err.empty());
    const auto verdict = result_in(folder / "r")["verdict"].get<std::string>();
    CHECK(verdict.find("not found within the budget") == 0);
    // Nothing is left to resume; what it found stands.
    const Ended again = rugosa(drawn + " --nodes 64 --pictures off --pipeline 'sample 4 | score | best 1' "
                                       "--reach-similarity 0.9999 --resume --out r",
                               folder.path());
    CHECK(again.code == 3);
    CHECK(again.out.find("is finished") != std::string::npos);
    CHECK(again.out.find(verdict) != std::string::npos);
}

TEST_CASE("however short the time, and when interrupted, the best so far is a valid result") {
    const Folder folder;
    for (const char* seconds : {"0.001", "0.5"}) {
        const Ended ended =
            rugosa(drawn + " --force --variant multistart --seconds " + seconds + " --out r", folder.path());
        INFO(ended.err << ended.out);
        CHECK(ended.code != 2);
        CHECK(result_in(folder / "r")["variants"]["multistart"]["genome"]["series"].size() >= 1);
    }
    const Ended drawn_too =
        rugosa(drawn + " --nodes 128 --reach-similarity 0.9 --out pictured", folder.path());
    CHECK(drawn_too.code == 0);
    CHECK_THAT(rough::read_whole(folder / "pictured/report.html"),
               Catch::Contains("<svg") && Catch::Contains("answer 1"));
    CHECK(rugosa_stopped(0.5, "stopped", drawn + " --variant plain --out stopped", folder.path()) == 130);
    CHECK(result_in(folder / "stopped")["interrupted"] == true);
    CHECK(result_in(folder / "stopped")["variants"]["plain"]["genome"]["series"].size() >= 1);
}

TEST_CASE("what a design cannot be asked is refused in one line that names it") {
    const Folder folder;
    folder.write("area.csv", "# kernel: strip\npressure_MPa,contact_fraction\n1e-5,0.2\n");
    folder.write("load.csv", "displacement_mm,pressure_MPa\n1e-5,0.2\n");
    for (const auto& [words, name] : std::vector<std::pair<std::string, std::string>>{
             {"design", "--target"},
             {drawn + " --like scan.txt", "--like"},
             {"design --target nowhere.csv", "nowhere.csv"},
             {"design --target area.csv", "kernel"},
             {"design --target load.csv --max-pressure 1", "load.csv"},
             {drawn + " --max-pressure 1e-5", "max-pressure"},
             {drawn + " --variant best-ever", "best-ever"},
             {drawn + " --pipeline 'score | bets 3'", "bets"},
             {drawn + " --variant sog --pipeline score", "--pipeline"},
             {drawn + " --weights 1,2", "--weights"},
             {drawn + " --unit um", "--unit"},
             {drawn + " --shortest-wave 100", "--shortest-wave"},
             {drawn + " --nodes 4", "--nodes"},
             {drawn + " --reach-similarity 2", "--reach-similarity"}}) {
        const Ended ended = rugosa(words + " --out r", folder.path());
        INFO(words << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK(ended.error_lines() == 1);
        CHECK(ended.out.empty());
        CHECK(ended.err.find(name) != std::string::npos);
    }
}

TEST_CASE("a design begins from a database's nearest curves and is better than they are") {
    const Folder folder;
    const std::string target =
        " --target '" RUGOSA_TEST_DATA "/target_heldout.csv' --nodes 128 --pictures off";
    REQUIRE(rugosa("database build g.db --genomes 2000 --nodes 128", folder.path()).code == 0);
    const Ended ended = rugosa("design --database g.db --out r" + target, folder.path());
    INFO(ended.out << ended.err);
    REQUIRE(ended.code != 2);
    CHECK_THAT(ended.out, Catch::Contains("2000 stored curves screened"));
    const json result = result_in(folder / "r");
    REQUIRE(rugosa("database query g.db --best 1 --out best.json --target '" RUGOSA_TEST_DATA
                   "/target_heldout.csv'",
                   folder.path())
                .code == 0);
    REQUIRE(rugosa("design --database g.db --seconds 1 --out quick" + target, folder.path()).code != 2);
    rough::DesignSetup setup;
    setup.model.grid.nodes = 128;
    setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_heldout.csv")};
    const rough::Genome best = rough::read_genome(folder / "best.json");
    rough::DesignSetup in_its_steps = setup; // as the answer is reported, not in the database's 20
    in_its_steps.model.loading.steps = result["steps"];
    CHECK(result["variants"]["in-line"]["similarity"].get<double>() >
          similarity(completed(in_its_steps), best));
    const double queried = rough::Verifier(completed(setup)).of(best).worst();
    CHECK(result_in(folder / "quick")["variants"]["in-line"]["similarity_worst"].get<double>() >=
          queried - 1e-9);
    for (const std::string words :
         {"--database none.db", "--database g.db --steps 10", "--database g.db --variant default"}) {
        const Ended refused = rugosa("design " + words + " --out other" + target, folder.path());
        INFO(words << ": " << refused.err);
        CHECK(refused.code == 2);
        CHECK(refused.error_lines() == 1);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "other"));
}

TEST_CASE("an answer that is not found ends with 3 though nobody asked for a similarity") {
    const Folder folder;
    const Ended ended = rugosa(
        drawn + " --nodes 64 --pictures off --pipeline 'sample 2 | score | best 1' --out r", folder.path());
    CHECK(ended.code == 3);
    CHECK(result_in(folder / "r")["verdict"].get<std::string>().find("not found within the budget") == 0);
}

TEST_CASE("a target wholly above full contact, and a datum just above the least, end with a result") {
    const Folder folder;
    for (const std::string words : {" --length 4", " --datum 0.21445"}) {
        const Ended ended = rugosa(drawn + words + " --max-pressure 1.6e-4 --nodes 128 --shortest-wave 0.2" +
                                       " --pictures off --seconds 2 --force --out r",
                                   folder.path());
        INFO(words << ": " << ended.err);
        CHECK(ended.code == 3);
        CHECK(result_in(folder / "r")["variants"]["default"]["similarity_worst"].is_number());
    }
}

TEST_CASE("a design in the default load steps is reported in steps that settle its similarity") {
    const Folder folder;
    const std::string words = drawn + " --nodes 64 --pictures off --kernel strip --out ";
    REQUIRE(rugosa(words + "chosen", folder.path()).code != 2);
    REQUIRE(rugosa(words + "kept --steps 20", folder.path()).code != 2);
    const json chosen = result_in(folder / "chosen"), kept = result_in(folder / "kept");
    CHECK(kept["steps"] == 20);
    const auto lost = [](const json& result) {
        const json& variant = result["variants"]["default"];
        return std::min(variant["similarity"].get<double>(), variant["similarity_refined"].get<double>()) -
               variant["similarity_worst"].get<double>();
    };
    CHECK(((lost(chosen) <= 0.005) ||
           chosen["variants"]["default"]["pipeline"] != kept["variants"]["default"]["pipeline"]));
    const double worst = kept["variants"]["default"]["similarity_worst"];
    CHECK(chosen["variants"]["default"]["similarity_worst"] >=
          worst - 1e-9 * std::abs(worst)); // but for rounding
}

TEST_CASE("a verdict has the digits that tell what was found from what was wanted") {
    const Folder folder;
    const Ended ended =
        rugosa("design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 128 --pictures off "
               "--reach-similarity 0.99999 --pipeline 'sample 4 | score | best 1' --out r",
               folder.path());
    INFO(ended.err);
    CHECK(ended.code == 3);
    CHECK_THAT(ended.out, Catch::Contains(", wanted is 0.99999 ("));
}
