#include "domain/mwm/genome_json.hpp"
#include "domain/problem/problem.hpp"
#include "domain/scan/source.hpp"
#include "domain/target/like.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

namespace {

/// 401 points on 2 mm.
void write_scan(const Folder& folder) {
    std::string text = "x [mm];z [mm]\n";
    for (int i = 0; i <= 400; ++i)
        text += std::to_string(0.005 * i) + ";" +
                std::to_string(1e-3 * (std::cos(0.05 * i) + 0.3 * std::cos(0.31 * i + 1))) + "\n";
    folder.write("scan.txt", text);
}

const std::string brief =
    "design --like scan.txt --nodes 128 --reach-similarity -1 --pipeline 'own 1 | score | "
    "refine lm 4' ";

} // namespace

TEST_CASE("a design like a scan asks for stiffness and area together, and for one where that is said") {
    const Folder folder;
    write_scan(folder);
    for (const auto& [flag, quantities] :
         {std::pair<std::string, std::vector<std::string>>("", {"stiffness_MPa_per_mm", "contact_fraction"}),
          {" --quantity area", {"contact_fraction"}},
          {" --quantity interface_stiffness", {"interface_stiffness_MPa_per_mm"}}}) {
        const Ended ended = rugosa(brief + "--pictures off --force --out r" + flag, folder.path());
        INFO(flag << ": " << ended.err);
        REQUIRE(ended.code == 0);
        const json result = result_in(folder / "r");
        REQUIRE(result["targets"].size() == quantities.size());
        for (std::size_t t = 0; t < quantities.size(); ++t)
            CHECK(result["targets"][t]["points"][0].contains(quantities[t]));
    }
    const Ended refused = rugosa(brief + "--quantity roughness --out other", folder.path());
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("--quantity"));
}

TEST_CASE("what was not asked for is said with how far the answer is off, the same on all three places") {
    const Folder folder;
    write_scan(folder);
    const Ended ended = rugosa(brief + "--quantity stiffness --out r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const json result = result_in(folder / "r"), summary = result["summary"];
    rough::ScanOptions options;
    const rough::Profile scan = rough::open_scan(folder / "scan.txt", options).measured;
    rough::DesignSetup setup;
    setup.like = scan;
    setup.model.grid = {128, result["length_mm"], false};
    setup.model.loading.steps = result["steps"];
    setup.model = completed(setup.model);
    setup.targets = {target_like(scan, setup.model, "area", rough::Quantity::area_at_pressure)};
    const rough::Genome genome = rough::genome_from_json(result["variants"]["pipeline"]["genome"], "genome");
    const double off = summary["not_asked"]["contact area"];
    CHECK(off == Approx(1 - similarity(setup, genome)).epsilon(1e-6));
    CHECK(summary["found"] == true);
    CHECK(summary["lowest"] == result["variants"]["pipeline"]["similarity_worst"]);
    const std::string page = rough::read_whole(folder / "r/report.html");
    for (const char* fact :
         {"matched", "not_asked_for", "worst_case", "yielding", "making", "carries_over"}) {
        const std::string text = summary[fact];
        INFO(fact << ": " << text);
        CHECK_THAT(ended.out, Catch::Contains(text));
        CHECK_THAT(page, Catch::Contains(text.substr(0, 20)));
    }
    CHECK_THAT(summary["not_asked_for"].get<std::string>(),
               Catch::Contains("interface stiffness was not asked"));
    CHECK_THAT(summary["carries_over"].get<std::string>(), Catch::Contains("length and datum alone"));
}

TEST_CASE("a verdict asked with noise or a hardness is a verdict under them") {
    const Folder folder;
    write_scan(folder);
    const auto verified = [&](const std::string& flags) {
        const Ended ended =
            rugosa("design --like scan.txt --nodes 128 --pipeline 'own 1 | score | refine lm 10' "
                   "--quantity stiffness --pictures off --force --out r" +
                       flags,
                   folder.path());
        INFO(flags << ": " << ended.err << ended.out);
        CHECK(ended.code == (result_in(folder / "r")["summary"]["found"].get<bool>() ? 0 : 3));
        return result_in(folder / "r")["summary"];
    };
    const double alone = verified("")["lowest"];
    const std::string asked = " --reach-similarity " + std::to_string(alone - 0.01);
    const json calm = verified(asked + " --noise 1e-9 --hardness 1e3");
    CHECK(calm["found"] == true);
    CHECK_THAT(calm["yielding"].get<std::string>(), Catch::StartsWith("elastic"));
    const json noisy = verified(asked + " --noise 0.01");
    CHECK(noisy["found"] == false);
    CHECK(noisy["lowest"] < alone - 0.01);
    const json soft = verified(asked + " --hardness 1e-3");
    CHECK(soft["found"] == false);
    CHECK_THAT(soft["yielding"].get<std::string>(), Catch::StartsWith("yields"));
}
