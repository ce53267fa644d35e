#include "apps/commands/design/files.hpp"
#include "apps/commands/design/summary.hpp"
#include "apps/report/render.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/problem/verification.hpp"
#include "domain/profile/solid.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string drawn = "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --max-pressure 1.6e-4 ";
const std::string short_way = " --pipeline 'shape 3 | score | best 2 | refine lm 4 | best 1'";

rough::DesignSetup setup_of(const json& result) {
    rough::DesignSetup setup;
    setup.model.grid.nodes = result["nodes"][0];
    setup.model.grid.rows = result["nodes"][1];
    setup.model.grid.length = result["length_mm"][0];
    setup.model.grid.width = result["length_mm"][1];
    if (result["kernel"] == "periodic")
        setup.model.body.kernel = rough::Kernel::periodic;
    setup.model.loading.steps = result["steps"];
    setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = result["max_pressure_MPa"].get<double>();
    return completed(setup);
}

} // namespace

TEST_CASE("a design on an area has the same files, and its similarities follow from its genome", "[areas]") {
    for (const char* kernel : {"free", "periodic"}) {
        const Folder folder;
        const Ended ended =
            rugosa(drawn + "--nodes 20x18 --length 0.84942x0.8 --kernel " + kernel + short_way + " --out r",
                   folder.path());
        INFO(ended.err << ended.out);
        REQUIRE(ended.code != 2);
        const json result = result_in(folder / "r");
        CHECK(result["nodes"] == json({20, 18}));
        CHECK(result["length_mm"] == json({0.84942, 0.8}));
        CHECK(result["datum_mm"].is_null());
        CHECK((ended.out.find("an area on a half-space needs no datum") != std::string::npos) ==
              (kernel == std::string("free")));
        const json& variant = result["variants"]["pipeline"];
        const rough::Genome genome = rough::genome_from_json(variant["genome"], "genome");
        const rough::DesignSetup setup = setup_of(result);
        CHECK(variant["similarity"].get<double>() == Approx(similarity(setup, genome)).margin(1e-5));
        CHECK(variant["similarity_refined"].get<double>() ==
              Approx(similarity(setup, genome, 4)).margin(1e-5));
        CHECK(variant["similarity_worst"].get<double>() ==
              Approx(rough::Verifier(setup).of(genome).worst()).margin(1e-5));
        CHECK(variant["genome"]["series"][0]["chromosomes"][0]["phases"].size() == 8);
        CHECK(variant["trust"]["checks"].size() == 4);
        CHECK(variant["trust"]["other_kernels"].size() == 1);
        CHECK(variant["margins"][1]["value"].get<double>() > 0);
        if (kernel[0] == 'f')
            CHECK((ended.out + ended.err).find("no datum") != std::string::npos);
        const std::string page = rough::read_whole(folder / "r" / "report.html");
        CHECK(page.find("20 x 18 nodes on 0.84942 x 0.8 mm") != std::string::npos);
        CHECK(page.find("<image") != std::string::npos);
        CHECK(page.find("Where it touches at the last load") != std::string::npos);
        CHECK(page.find("No picture") == std::string::npos);
        // The tile to print is the answer's own.
        const rough::Profile answer = sample(genome, setup.model.grid);
        CHECK(rough::read_whole(folder / "r" / "surface.stl") == binary_stl(answer));
        CHECK(rough::read_whole(folder / "r" / "surface.3mf") == three_mf(answer));
    }
}

TEST_CASE("a design like a map answers for the map's own stiffness and contact area, on its nodes",
          "[areas]") {
    const Folder folder;
    std::string matrix;
    for (int j = 0; j < 18; ++j)
        for (int i = 0; i < 20; ++i)
            matrix += std::to_string(std::cos(0.3 * i + 0.1 * j) + 0.5 * std::cos(0.5 * j - 0.2 * i + 1)) +
                      (i == 19 ? "\n" : " ");
    folder.write("map.txt", matrix);
    const Ended ended =
        rugosa("design --like map.txt --unit um --spacing 40x45 --out r" + short_way, folder.path());
    INFO(ended.err << ended.out);
    REQUIRE(ended.code != 2);
    const json result = result_in(folder / "r");
    CHECK(result["nodes"] == json({20, 18}));
    CHECK(result["length_mm"][0].get<double>() == Approx(0.76));
    CHECK(result["length_mm"][1].get<double>() == Approx(0.765));
    CHECK(result["targets"].size() == 2);
    CHECK(rough::read_whole(folder / "r" / "report.html").find("The map") != std::string::npos);
}

TEST_CASE("a design on an area that there is no time to verify is said to be not verified, without a number",
          "[areas]") {
    const Folder folder;
    const Ended ended =
        rugosa(drawn + "--nodes 24x24 --length 0.84942 --seconds 1e-3 --out r", folder.path());
    INFO(ended.err << ended.out);
    REQUIRE(ended.code == 3);
    const json result = result_in(folder / "r");
    const json& variant = result["variants"]["maps"];
    CHECK(variant["similarity"].is_number());
    CHECK(variant["similarity_refined"].is_null());
    CHECK(variant["similarity_worst"].is_null());
    CHECK(variant["alternatives"][0]["similarity_worst"].is_null());
    CHECK(result["summary"]["lowest"].is_null());
    CHECK(result["summary"]["found"] == false);
    CHECK(result["verdict"].get<std::string>().rfind("not verified: similarity ", 0) == 0);
    CHECK_THAT(result["summary"]["worst_case"].get<std::string>(),
               Catch::Contains("not verified on a grid 4 times finer"));
    CHECK_THAT(ended.out + ended.err, Catch::Contains("there was no time"));
    CHECK((ended.out + ended.err).find("nan") == std::string::npos);
    const auto rows = rows_of(folder / "r" / "answer.csv");
    REQUIRE(rows.size() == 20);
    // The similarity on its own grid is that of the curve that is written.
    CHECK(rows.back()[1] == Approx(1.6e-4));
    CHECK(variant["similarity"].get<double>() ==
          Approx(similarity(setup_of(result), rough::genome_from_json(variant["genome"], "genome")))
              .margin(1e-5));
}

TEST_CASE("the page of an area that was not verified draws its own curve alone and says so", "[areas]") {
    app::DesignRun run;
    run.setup.model.grid.nodes = run.setup.model.grid.rows = 20;
    run.setup.model.grid.width = run.setup.model.grid.length;
    run.setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    run.setup.max_pressure = 1.6e-4;
    run.setup = run.searched = completed(run.setup);
    run.options.seconds = 0;
    run.options.alternatives = 1;
    run.setup.required_similarity = rough::default_required_similarity;
    run.found = search(run.setup, run.options);
    run.own = response_of(run.setup, run.found.best);
    run.trust_options.phase_draws = 0;
    run.trust = trust_in(run.setup, run.found.best.genome, run.trust_options, &run.found.best, &run.own);
    run.summary = app::summary_of(run);
    CHECK_FALSE(run.summary.found);
    run.origin.kind = "design";
    const Folder folder;
    write_design_result(run, folder.path());
    write_design_drawings(run, folder.path());
    const std::string page = render(app::page_source(folder.path()));
    CHECK(page.find("not verified: similarity ") != std::string::npos);
    CHECK(page.find("There was no time to verify the answer") != std::string::npos);
    CHECK(page.find("There was no time for: 4 times the nodes; 4 times the load steps") != std::string::npos);
    CHECK(page.find("No picture") == std::string::npos);
    CHECK(page.find("Where it touches at the last load") != std::string::npos);
    CHECK(page.find(">finer grid<") == std::string::npos);
    CHECK(page.find("nan") == std::string::npos);
}

TEST_CASE("a design on an area is the same on one thread and on two", "[areas]") {
    const Folder folder;
    for (const char* threads : {"1", "2"})
        REQUIRE(rugosa(drawn + "--nodes 24x24 --length 0.84942 --pictures off --threads " + threads +
                           " --ridges 3 --out r" + threads + short_way,
                       folder.path())
                    .code != 2);
    json one = timeless(result_in(folder / "r1")), two = timeless(result_in(folder / "r2"));
    CHECK(one == two);
    CHECK(one["variants"]["pipeline"]["genome"]["series"][0]["chromosomes"][0]["phases"].size() == 3);
}

TEST_CASE("what a design on an area cannot be given is refused in one line", "[areas]") {
    const Folder folder;
    folder.write("scan.txt", "0 1 0.5\n0.25 3 1\n0 1.5 2.5\n0.5 0 1\n");
    folder.write(
        "of_profile.csv",
        "# kernel: free\n# datum_mm: 0.84942\npressure_MPa,stiffness_MPa_per_mm\n1e-6,0.4\n2e-6,0.5\n");
    folder.write("of_area.csv",
                 "# kernel: free\n# width_mm: 0.8\npressure_MPa,stiffness_MPa_per_mm\n1e-6,0.4\n2e-6,0.5\n");
    for (const auto& [words, expected] :
         {std::pair(drawn + "--nodes 32x32 --datum 2", "--datum"),
          std::pair(drawn + "--nodes 32x32 --accuracy 1e-3", "--accuracy"),
          std::pair(drawn + "--nodes 32x32 --kernel strip", "strip"),
          std::pair(drawn + "--nodes 32x32 --database g.db", "--database"),
          std::pair(drawn + "--nodes 8x32", "--nodes: 8"), std::pair(drawn + "--nodes 32x", "32x"),
          std::pair(drawn + "--nodes 32x32 --ridges 0", "--ridges"),
          std::pair(std::string("design --like scan.txt --spacing 1x1 --nodes 32x32"), "--nodes"),
          std::pair(std::string("design --like scan.txt --nodes 32x32"), "--nodes"),
          std::pair(std::string("design --like scan.txt --spacing 1x1"), "16 at least"),
          std::pair(std::string("design --target of_profile.csv --nodes 32x32"), "datum_mm"),
          std::pair(std::string("design --target of_area.csv --nodes 32"), "width_mm"),
          std::pair(std::string("run '" RUGOSA_SOURCE "/experiments/paper.ini' --nodes 32x32"), "32x32")}) {
        const Ended ended = rugosa(words, folder.path());
        INFO(words << ": " << ended.err);
        check_refused(ended, expected);
    }
}

TEST_CASE("the paper's algorithms run on areas beside the same on profiles", "[areas]") {
    const Folder folder;
    const Ended ended = rugosa("run '" RUGOSA_SOURCE "/experiments/surface.ini' --pictures off "
                               "--nodes 16x16,64 --set targets.shortest-wave=0.2 --out r",
                               folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json area = result_in(folder / "r"), line = result_in(folder / "r" / "drawn-64");
    CHECK(area["nodes"] == json({16, 16}));
    CHECK(line["nodes"] == 64);
    for (const char* name : {"sog", "gco", "cco"}) {
        const json& variant = area["variants"][name];
        CHECK(variant["genome"]["series"][0]["chromosomes"][0]["phases"].size() == 8);
        CHECK(line["variants"][name]["genome"]["series"][0]["chromosomes"][0]["phases"].size() == 1);
        CHECK(variant["similarity_worst"].get<double>() <= variant["similarity"].get<double>());
        const json& answer = variant["stages"].back()["candidates"][0];
        CHECK(answer["parents"].size() == (std::string(name) == "sog" ? 0 : 2));
        std::size_t above = 0;
        for (const json& stage : variant["stages"])
            if (stage["path"] == std::string(name) + "/pair.1/left/above.1")
                above = stage["candidates"].size();
        CHECK(above >= (std::string(name) == "sog" ? 0 : 3));
    }
}
