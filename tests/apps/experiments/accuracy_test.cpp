#include "apps/experiments/solvers/accuracy.hpp"
#include "apps/report/render.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string small = "run '" RUGOSA_SOURCE "/experiments/accuracy.ini' --set accuracy.surfaces=1 --set "
                          "accuracy.accuracies=3e-2,1e-2 --set accuracy.rough-waves=32 --set "
                          "accuracy.design-budget=40 --set model.nodes=128 ";

} // namespace

TEST_CASE("the accuracy experiment charts every kind of scene and ends in a budget") {
    const Folder folder;
    const json result = result_of(rugosa(small + "--pictures off --out e", folder.path()), folder / "e");
    CHECK(result["accuracy"] == 0.01);
    REQUIRE(result["savings"].size() == 16); // two surfaces, kernels, loads and accuracies
    for (const json& row : result["savings"]) {
        CHECK(row["seconds"] > 0);
        CHECK(row["estimated_error"] <= 1.01 * row["accuracy"].get<double>());
        CHECK(row["true_error"] <= 3 * row["accuracy"].get<double>());
    }
    std::set<std::string> kinds;
    for (const json& row : result["error_budget"])
        kinds.insert(row["kind"]);
    CHECK(kinds == std::set<std::string>{"model", "numerical", "target"});
    const json& design = result["variants"]["default"];
    CHECK(result["error_budget"].back()["size"].get<double>() ==
          Approx(1 - design["similarity_refined"].get<double>()));
    for (const char* table : {"savings.csv", "budget.csv"})
        CHECK(std::filesystem::exists(folder / "e" / table));
}

TEST_CASE("an error is covered by an estimate that is no smaller, and the page draws what there is") {
    app::AccuracyRun run;
    for (const double true_error : {0.0, 0.004, 0.008, 0.0081, 0.02}) {
        app::SavingRow row;
        row.surface = "smooth";
        row.kernel = "free";
        row.load = "full";
        row.accuracy = 0.01;
        row.seconds = 2;
        row.resolved_seconds = 6;
        row.estimated_error = 0.008;
        row.true_error = true_error;
        CHECK(row.covered() == (true_error <= 0.008));
        run.savings.push_back(row);
    }
    run.origin.kind = "accuracy";
    run.setup.targets = {rough::read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    run.setup.max_pressure = 1.6e-4;
    run.design.name = "default";
    run.design.answer.genome.series = {{1, 0.8, 1.5, 0.85, {{1, {0.3}}}}};
    run.budget = {{"model", "a datum", 0.01}, {"numerical", "the grid", 0.001}};
    const Folder folder;
    app::Findings findings = findings_of(run);
    app::write(findings, run.origin, folder.path());
    const std::string page = render(app::page_source(folder.path()));
    CHECK_THAT(page, Catch::Contains("60.0 %") && Catch::Contains("80.0 %")); // three of five, four of five
    CHECK(rough::read_whole(folder / "medians.csv").ends_with("\nfree,smooth,full,0.01,2000,3\n"));
    CHECK(found(page, "<figure id=\"figure-(\\d)\"") == std::vector<std::string>{"1", "2", "3"});
}

TEST_CASE("a page escapes what a result says, and rendering a folder again gives the same page") {
    const Folder folder;
    folder.write("result.json", R"({"kind":"accuracy","command":"rugosa <script>","error_budget":[]})");
    folder.write("coverage.csv", "accuracy,scenes,covered,within,worst_over_accuracy,median_saving\n");
    folder.write("medians.csv", "kernel,surface,load,accuracy,milliseconds,saving\n");
    const std::string page = render(app::page_source(folder.path()));
    CHECK_THAT(page, Catch::Contains("rugosa &lt;script&gt;") && !Catch::Contains("<script"));
    const Ended again = rugosa("report .", folder.path());
    INFO(again.err);
    CHECK(again.code == 0);
    CHECK(rough::read_whole(folder / "report.html") == page);
    folder.write("result.json", R"({"kind":"../accuracy"})");
    const Ended refused = rugosa("report .", folder.path());
    CHECK(refused.code == 2);
    CHECK(refused.error_lines() == 1);
}
