#include "apps/prompt/units.hpp"
#include "domain/database/screen.hpp"
#include "domain/profile/solid.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string drawn = "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv'";
const std::string small =
    "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 65 --force --out r "
    "--pipeline 'shape 6 | score | best 2 | refine lm 8 | best 1'";
const std::string pictured = " --pipeline 'shape 6 | score | best 2 | refine lm 8 | best 2'";
const std::string brief = " --pictures off" + pictured;

/// The set-up of a design for the paper's drawn target, as its result.json tells it.
rough::DesignSetup setup_of(const json& result) {
    rough::Model model;
    rough::Grid& grid = model.grid;
    if (result["nodes"].is_array()) {
        grid.nodes = result["nodes"][0], grid.rows = result["nodes"][1];
        grid.length = result["length_mm"][0], grid.width = result["length_mm"][1];
    } else {
        grid.nodes = result["nodes"], grid.length = result["length_mm"];
        model.contact.solver = rough::Solver::nested;
    }
    if (result["kernel"] == "periodic") model.body.kernel = rough::Kernel::periodic;
    if (!result["datum_mm"].is_null()) model.body.datum = result["datum_mm"].get<double>();
    model.loading.steps = result["steps"];
    rough::DesignSetup setup{.model = rough::completed(model),
                             .targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")}};
    if (!result["max_pressure_MPa"].is_null()) setup.max_pressure = result["max_pressure_MPa"].get<double>();
    return setup;
}

} // namespace

TEST_CASE("the similarities of a design follow from its genome, for profiles and maps") {
    const std::string map = " --max-pressure 1.6e-4 --nodes 20x18 --length 0.84942x0.8 --kernel ";
    for (const std::string& mode :
         {std::string(), std::string(" --max-pressure 1.6e-4 --pictures off"), map + "free", map + "periodic"}) {
        INFO(mode);
        const Folder folder;
        const Ended ended = answered(rugosa(drawn + mode + pictured + " --out r", folder.path()));
        const json result = result_in(folder / "r");
        const rough::DesignSetup setup = setup_of(result);
        const bool is_map = setup.model.grid.is_2d();
        const double error = is_map ? 1e-5 : 1e-9;
        const json& variant = result["variants"]["pipeline"];
        const rough::Genome genome = rough::genome_from_json(variant["genome"], "genome");
        CHECK(variant["similarity"].get<double>() == Approx(similarity(setup, genome)).margin(error));
        CHECK(variant["similarity_refined"].get<double>() == Approx(similarity(setup, genome, 4)).margin(error));
        const rough::Verification verified = rough::Verifier(is_map ? setup : as_reported(setup)).of(genome);
        CHECK(variant["similarity_worst"].get<double>() == Approx(verified.worst).margin(error));
        CHECK_THAT(result["summary"]["matched"].get<std::string>(),
                   Catch::Contains("off by up to " + app::percent(1 - verified.worst) + " with the estimated error"));
        CHECK(ended.code == (variant["similarity_worst"].get<double>() >= rough::default_required_similarity ? 0 : 3));
        CHECK(variant["tolerance"]["similarity"].get<double>() == Approx(verified.worst).margin(10 * error));
        CHECK(variant["alternatives"].size() >= 1);
        CHECK(variant["trust"]["checks"].size() == (is_map ? 3 : 4));
        CHECK(variant["trust"]["tenth_percentile"] <= variant["trust"]["median"]);
        CHECK(rough::genes(rough::read_genome(folder / "r" / "genome.json")) == rough::genes(genome));
        if (setup.max_pressure && !is_map) // the amplitude is in final form: full approach is at p_max
            CHECK(respond(genome, setup.model).pressure.tail(1)[0] == Approx(1.6e-4).epsilon(1e-9));
        if (is_map) { // the tile to print is that of the answer
            CHECK(genome.series[0].chromosomes[0].phases.size() == 8);
            const rough::Profile answer = sample(genome, setup.model.grid);
            const rough::Extrusion extrusion{.periodic = setup.model.grid.periodic};
            CHECK(rough::read_whole(folder / "r" / "surface.stl") == binary_stl(answer, extrusion));
            CHECK(rough::read_whole(folder / "r" / "surface.3mf") == three_mf(answer, extrusion));
            CHECK(rough::read_whole(folder / "r" / "surface.png") == height_image(answer).png);
        }
        if (!is_map && setup.max_pressure) continue;
        const std::string page = rough::read_whole(folder / "r/report.html");
        CHECK_THAT(page, Catch::Contains("id=\"target-1\"") && Catch::Contains(is_map ? "<image" : "id=\"profiles\"") &&
                             !Catch::Contains("No picture"));
        done(folder, "report r --out again.html");
        CHECK(rough::read_whole(folder / "again.html") == page);
    }
}

TEST_CASE("a target out of reach is reported with the pressures at fault") {
    const Folder folder;
    folder.write("falls.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-5,0.5\n5e-5,0.8\n1e-4,0.6\n");
    folder.write("stiff.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-5,0.5\n5e-5,0.8\n1e-4,3\n");
    for (const auto& [name, word, at] :
         {std::tuple("falls", "falls", 5e-5), std::tuple("stiff", "full contact", 1e-4)}) {
        const Ended ended = rugosa(
            std::string("design --target ") + name + ".csv --nodes 128" + brief + " --out " + name, folder.path());
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

TEST_CASE("a design that misses its required similarity exits with 3 and a result") {
    const Folder folder;
    const std::string words = drawn + " --nodes 64 --pictures off --pipeline 'sample 4 | score | best 1' "
                                      "--out r --reach-similarity ";
    const Ended ended = rugosa(words + "0.9999", folder.path());
    CHECK(ended.code == 3);
    CHECK(ended.err.empty());
    CHECK_THAT(result_in(folder / "r")["verdict"].get<std::string>(),
               Catch::StartsWith("not found: ")); // the pipeline ended by itself
    // Nor is an answer found that is similar enough and steeper than allowed.
    CHECK(rugosa(words + "0.01 --force --max-slope 1e-6", folder.path()).code == 3);
    CHECK_THAT(result_in(folder / "r")["verdict"].get<std::string>(),
               Catch::StartsWith("not found: lowest similarity") && Catch::Contains("limits on shape"));
}

TEST_CASE("a design leaves a valid result in any time, and when interrupted") {
    const Folder folder;
    for (const char* seconds : {"0.001", "0.5"}) {
        const Ended ended =
            rugosa(drawn + " --force --variant multistart --seconds " + seconds + " --out r", folder.path());
        INFO(ended.err << ended.out);
        CHECK(ended.code != 2);
        CHECK(result_in(folder / "r")["variants"]["multistart"]["genome"]["series"].size() >= 1);
        const std::string page = rough::read_whole(folder / "r/report.html");
        CHECK_THAT(page, Catch::Contains("Requested and found") && !Catch::Contains(" 0 draws"));
        const json tolerance = result_in(folder / "r")["variants"]["multistart"]["tolerance"];
        const bool has_noise = !tolerance["levels"].back()["noise_rms_mm"].is_null();
        CHECK((tolerance["draws"] > 0) == has_noise);
        CHECK((page.find("tolerance to noise was not computed for lack of time") != page.npos) == !has_noise);
    }
    const Ended drawn_too = rugosa(drawn + " --nodes 128 --reach-similarity 0.9 --out pictured", folder.path());
    CHECK(drawn_too.code == 0);
    CHECK_THAT(rough::read_whole(folder / "pictured/report.html"),
               Catch::Contains("<svg") && Catch::Contains("answer 1"));
    CHECK(rugosa_stopped(0.5, "cut", drawn + " --variant plain --out cut", folder.path()).code == 130);
    CHECK(result_in(folder / "cut")["interrupted"] == true);
    CHECK(result_in(folder / "cut")["variants"]["plain"]["genome"]["series"].size() >= 1);
    CHECK_THAT(rough::read_whole(folder / "cut/report.html"), Catch::Contains("the design was interrupted"));
}

TEST_CASE("a design from a database is better than its nearest curves") {
    const Folder folder;
    const std::string target =
        " --target '" RUGOSA_SOURCE "/experiments/targets/heldout.csv' --nodes 128 --pictures off";
    done(folder, "database build g.db --genomes 2000 --nodes 128");
    const Ended ended = answered(rugosa("design --database g.db --out r" + target, folder.path()));
    CHECK_THAT(ended.out, Catch::Contains("2000 stored curves screened"));
    const json result = result_in(folder / "r");
    done(folder,
         "database query g.db --best 1 --out best.json --target '" RUGOSA_SOURCE "/experiments/targets/heldout.csv'");
    REQUIRE(rugosa("design --database g.db --seconds 1 --out quick" + target, folder.path()).code != 2);
    const rough::DesignSetup setup{.model = rough::completed({.grid = {.nodes = 128}}),
                                   .targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/heldout.csv")}};
    const rough::Genome best = rough::read_genome(folder / "best.json");
    rough::DesignSetup in_its_steps = setup; // as the answer is reported, not in the database's 20
    in_its_steps.model.loading.steps = result["steps"];
    CHECK(result["variants"]["in-line"]["similarity"].get<double>() > similarity(in_its_steps, best));
    // The nearest stored curve, where even the shortest search begins.
    const rough::Genome nearest = stored_starts(rough::GenomeStore::open(folder / "g.db"), setup, 1).front();
    CHECK(result_in(folder / "quick")["variants"]["in-line"]["similarity_worst"].get<double>() >=
          rough::Verifier(setup).of(nearest).worst - 1e-9);
}

TEST_CASE("a map designed from a database is better than its nearest curves") {
    const Folder folder;
    const std::string target = " --target '" RUGOSA_SOURCE "/experiments/targets/heldout.csv' --max-pressure 1.6e-4";
    done(folder, "database build g.db --genomes 100 --nodes 32x32 --length 0.84942");
    const Ended nearest = done(folder, "database query g.db --best 1 --out best.json" + target);
    double similarity = 0;
    REQUIRE(std::sscanf(nearest.out.c_str() + nearest.out.find("\n   1 "), " 1 %*d %*f %lf", &similarity) == 1);
    const Ended ended =
        answered(rugosa("design --database g.db --nodes 32x32 --out r --pictures off" + target, folder.path()));
    CHECK_THAT(ended.out, Catch::Contains("100 stored curves screened"));
    CHECK(result_in(folder / "r")["variants"]["maps-in-line"]["similarity_worst"].get<double>() > similarity + 0.01);
    const Ended other = rugosa("design --database g.db --nodes 40x32 --out o" + target, folder.path());
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("g.db: a database of another set-up: its nodes is 32, not 40"));
}

TEST_CASE("a design like a map has two targets on the nodes of the map", "[areas]") {
    const Folder folder;
    const auto height = [](int i, int j) {
        return std::cos(0.3 * i + 0.1 * j) + 0.5 * std::cos(0.5 * j - 0.2 * i + 1);
    };
    folder.write("map.txt", table_text(20, 18, height));
    const json result = result_of(folder, "design --like map.txt --unit um --spacing 40x45" + pictured);
    CHECK(result["nodes"] == json({20, 18}));
    CHECK(result["length_mm"][0].get<double>() == Approx(0.8));
    CHECK(result["length_mm"][1].get<double>() == Approx(0.81));
    CHECK(result["targets"].size() == 2);
}

TEST_CASE("a map without time to verify is reported as not verified", "[areas]") {
    const Folder folder;
    const Ended ended =
        rugosa(drawn + " --max-pressure 1.6e-4 --nodes 24x24 --length 0.84942 --seconds 1e-3 --out r", folder.path());
    INFO(ended.err << ended.out);
    REQUIRE(ended.code == 3);
    const json result = result_in(folder / "r");
    const json& variant = result["variants"]["maps"];
    CHECK(variant["similarity"].is_number());
    CHECK((variant["similarity_refined"].is_null() && variant["similarity_worst"].is_null()));
    CHECK((result["summary"]["lowest"].is_null() && result["summary"]["found"] == false));
    CHECK(result["verdict"].get<std::string>().rfind("not verified: similarity ", 0) == 0);
    CHECK_THAT(result["summary"]["worst_case"].get<std::string>(),
               Catch::Contains("not verified on a grid 4 times finer"));
    CHECK_THAT(ended.out + ended.err, Catch::Contains("the time did not suffice"));
}

TEST_CASE("a design out of time resumes to the same result, but not with another set-up") {
    const Folder folder;
    const std::string words =
        "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 128 --threads 1 --pictures off "
        "--max-slope 0.5 --pipeline 'shape 12 | score | best 4 | refine lm 6 | repeat 12 { tournament 2 | "
        "cross uniform | mutate 0.1 | score | refine lm 6 | elite 1 } | best 2 | score verified'";
    const Ended whole = rugosa(words + " --out whole", folder.path());
    REQUIRE(whole.code != 2);
    // On a machine of any speed, a short enough time ends the search, or shortens the tolerance after it.
    int unfinished = 0;
    for (double seconds = 0.7 * whole.seconds; unfinished < 3 && seconds > 1e-3; seconds *= 0.8) {
        const Ended cut = rugosa(words + " --force --out cut --seconds " + std::to_string(seconds), folder.path());
        REQUIRE(cut.code != 2);
        if (cut.out.find("--resume") == std::string::npos) continue;
        if (++unfinished == 1)
            check_refused(rugosa(words + " --max-height 1 --out cut --resume", folder.path()), "checkpoint");
        REQUIRE(rugosa(words + " --out cut --resume", folder.path()).code != 2);
        INFO(seconds << " of " << whole.seconds);
        CHECK(timeless(result_in(folder / "cut")) == timeless(result_in(folder / "whole")));
    }
    REQUIRE(unfinished > 0);
    check_refused(rugosa(words + " --resume", folder.path()), "--out");
}

TEST_CASE("a design without limits reports that it is not known whether it can be made") {
    const Folder folder;
    REQUIRE(rugosa(small + " --pictures off", folder.path()).code != 2);
    CHECK_THAT(result_in(folder / "r")["summary"]["making"].get<std::string>(),
               Catch::StartsWith("not known, as no limit was given") && Catch::Contains("--max-slope"));
    CHECK(result_in(folder / "r")["limits_given"] == false);
    REQUIRE(rugosa(small + " --pictures off --max-slope 1", folder.path()).code != 2);
    CHECK_THAT(result_in(folder / "r")["summary"]["making"].get<std::string>(), Catch::StartsWith("yes, by"));
}

TEST_CASE("a design of a material is checked against its hardness, and speaks of its target's quantity") {
    const Folder folder;
    done(folder, "target --formula '3e4 * p^0.95' --quantity conductance --conductivity 167 --material "
                 "aluminium --length 10 "
                 "--to 5 --points 6 --out h.csv");
    REQUIRE(rugosa("design --target h.csv --conductivity 167 --material aluminium --length 10 --nodes 65 --pictures "
                   "off --out r --pipeline 'shape 6 | score | best 2 | refine lm 8 | best 1'",
                   folder.path())
                .code != 2);
    const json summary = result_in(folder / "r")["summary"];
    CHECK_THAT(summary["matched"].get<std::string>(), Catch::StartsWith("conductance: similarity "));
    CHECK_THAT(summary["yielding"].get<std::string>(), Catch::StartsWith("yes, the highest node pressure"));
}
