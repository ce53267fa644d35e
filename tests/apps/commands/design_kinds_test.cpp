#include "domain/problem/problem.hpp"
#include "domain/scan/scan.hpp"
#include "tests/apps/results.hpp"

#include <numbers>

using namespace app::testing;
using nlohmann::json;

namespace {

/// Stiffness and contact area that no one surface has: those of two different ones.
std::string two_targets(const Folder& folder) {
    folder.write("a.json", genome_text(1, 0.8, 1.5, {{1, {0.3}}, {2, {2}}, {3, {4}}}));
    folder.write("b.json", genome_text(1, 1.2, 1.5, {{1, {3}}, {2, {1}}}));
    done(folder, "target --genome a.json --nodes 128 --to 1e-2 --out K.csv");
    done(folder, "target --genome b.json --nodes 128 --to 1e-2 --quantity area --out A.csv");
    return "design --target K.csv,A.csv --nodes 128 ";
}

/// A surface with these phases of its second and fourth waves.
std::string drifting(double second, double fourth) {
    return genome_text(1, 0.9, 1.6, {{1, {0.3}}, {2, {second}}, {3, {4}}, {4, {fourth}}});
}

/// 401 points on 2 mm.
void write_scan(const Folder& folder) {
    const auto height = [](int i) { return 1e-3 * (std::cos(0.05 * i) + 0.3 * std::cos(0.31 * i + 1)); };
    folder.write("scan.txt", profile_text("x [mm];z [mm]", 401, 0.005, height));
}

const std::string from_scan = "design --like scan.txt --nodes 128 --reach-similarity -1 --pipeline 'own 1 | score | "
                              "refine lm 4' ";

} // namespace

TEST_CASE("two targets give a front whose similarities follow from its genomes") {
    const Folder folder;
    const json result = result_of(
        folder, two_targets(folder) +
                    "--pipeline 'shape 12 | score | refine lm 3 | pareto goal1 goal2 | repeat 2 { tournament 2 "
                    "| cross uniform | mutate 0.1 | parents | pareto goal1 goal2 | best 12 } | front'");
    const json& front = result["variants"]["pipeline"]["front"];
    REQUIRE(front.size() > 1);
    const rough::DesignSetup setup{
        .model = rough::completed({.grid = {128}}),
        .targets = {rough::read_target(folder / "K.csv"), rough::read_target(folder / "A.csv")}};
    double best = -HUGE_VAL;
    for (const json& one : front) {
        const rough::Genome genome = rough::genome_from_json(one["genome"], "genome");
        for (const auto& [name, refine] : {std::pair("similarity", 1), std::pair("similarity_refined", 4)}) {
            const auto each = similarities(setup, respond(setup, genome, rough::refined(setup.model, refine)));
            for (std::size_t g = 0; g < 2; ++g) CHECK(one[name][g].get<double>() == Approx(each[g]).margin(1e-9));
        }
        best = std::max(
            best, std::min({one["similarity"][0].get<double>(), one["similarity"][1].get<double>(),
                            one["similarity_refined"][0].get<double>(), one["similarity_refined"][1].get<double>()}));
    }
    const json& variant = result["variants"]["pipeline"];
    CHECK(std::min(variant["similarity"].get<double>(), variant["similarity_refined"].get<double>()) >= best - 0.05);
    CHECK_THAT(rough::read_whole(folder / "r/report.html"), Catch::Contains("Conflict between the targets"));
}

TEST_CASE("the answers of all variants hold the limits on shape") {
    const Folder folder;
    const std::vector<std::string> all{"default", "multistart", "plain", "sog", "gco", "cco"};
    const std::vector<std::string> few{"default", "sog", "gco"}; // Eq. 11 leaves amplitude no freedom
    for (const std::string mode : {"", " --max-pressure 1.6e-4"})
        for (const std::string& variant : mode.empty() ? all : few) {
            const std::string words = "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 64 "
                                      "--pictures off --max-slope 6e-4 --max-height 2e-4 "
                                      "--min-radius 5 --shortest-wave 0.04 --force --variant " +
                                      variant + mode;
            const json answer = result_of(folder, words)["variants"][variant];
            CHECK(answer["within_limits"] == true);
            for (const json& margin : answer["margins"]) CHECK(margin["margin"].get<double>() >= 0);
        }
}

TEST_CASE("the genes of a design keep to the given bounds") {
    const Folder folder;
    const json all =
        result_of(folder,
                  "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 64 --shortest-wave 0.1 "
                  "--pictures off --pipeline 'sample 8 | score | refine lm 3 | best 1' --hurst-from 0.6 --hurst-to "
                  "0.65 --gamma-from 1.75 --gamma-to 1.8 --lambda-from 0.5 --lambda-to 0.6")["variants"]["pipeline"]
                                                                                            ["genome"]["series"];
    REQUIRE_FALSE(all.empty());
    for (const json& series : all)
        for (const auto& [gene, from, to] :
             {std::tuple("H", 0.6, 0.65), std::tuple("gamma", 1.75, 1.8), std::tuple("lambda", 0.5, 0.6)}) {
            CHECK(series[gene].get<double>() >= from);
            CHECK(series[gene].get<double>() <= to);
        }
}

TEST_CASE("a drifted surface is brought back by changing only the controlled chromosomes") {
    for (const std::string map : {"", " --nodes 48x16 --length 0.84942"}) {
        const Folder folder;
        folder.write("wanted.json", drifting(1.9, 2.2));
        folder.write("drifted.json", drifting(2.2, 1.9));
        done(folder, "target --genome wanted.json --out T.csv" + map);
        answered(
            rugosa("design --from drifted.json --control 1:2,1:4 --largest-change 0.1 --target T.csv --out r" + map,
                   folder.path()));
        const json result = result_in(folder / "r"), answer = result["variants"]["morph"];
        const double before_change = answer["morph"]["similarity_before"], worst = answer["similarity_worst"];
        CHECK(before_change < 0.97);
        CHECK(answer["morph"]["changes"].size() == 2);
        if (map.empty()) {
            CHECK(answer["similarity"].get<double>() >= 0.99);
            CHECK(answer["morph"]["out_of_reach"].empty());
        } else { // the surface decides, not its grid
            CHECK(worst > before_change + 0.05);
            CHECK(result["summary"]["found"] == (worst >= 0.99));
        }
        const rough::Genome before = rough::read_genome(folder / "drifted.json"),
                            after = rough::read_genome(folder / "r" / "genome.json");
        for (const std::size_t kept : {0u, 2u})
            CHECK(before.series[0].chromosomes[kept].phases == after.series[0].chromosomes[kept].phases);
        for (const std::size_t moved : {1u, 3u})
            CHECK(std::abs(before.series[0].chromosomes[moved].phases[0] -
                           after.series[0].chromosomes[moved].phases[0]) <= 0.2 * std::numbers::pi);
    }
}

TEST_CASE("a design like a scan has the targets stiffness and area, or a given one") {
    const Folder folder;
    write_scan(folder);
    for (const auto& [flag, quantities] :
         {std::pair<std::string, std::vector<std::string>>("", {"stiffness_MPa_per_mm", "contact_fraction"}),
          {" --quantity area", {"contact_fraction"}},
          {" --quantity interface_stiffness", {"interface_stiffness_MPa_per_mm"}}}) {
        const json result = result_of(folder, from_scan + "--pictures off --force" + flag);
        REQUIRE(result["targets"].size() == quantities.size());
        for (std::size_t t = 0; t < quantities.size(); ++t)
            CHECK(result["targets"][t]["points"][0].contains(quantities[t]));
    }
}

TEST_CASE("the error in quantities that were not requested is on terminal, page and in result.json") {
    const Folder folder;
    write_scan(folder);
    const Ended ended = answered(rugosa(from_scan + "--quantity stiffness --out r", folder.path()));
    const json result = result_in(folder / "r"), summary = result["summary"];
    rough::ScanOptions options;
    const rough::Profile scan = rough::open_scan(folder / "scan.txt", options).measured;
    const rough::Model model = rough::completed({.grid = {128, result["length_mm"]}, .loading = {result["steps"]}});
    const rough::DesignSetup setup{.model = model,
                                   .targets = {target_like(scan, model, "area", rough::Quantity::area_at_pressure)},
                                   .measured = scan};
    const rough::Genome genome = rough::genome_from_json(result["variants"]["pipeline"]["genome"], "genome");
    const double off = summary["unrequested_errors"]["contact area"];
    CHECK(off == Approx(1 - similarity(setup, genome)).epsilon(1e-6));
    CHECK(summary["found"] == true);
    CHECK(summary["lowest"] == result["variants"]["pipeline"]["similarity_worst"]);
    const std::string page = rough::read_whole(folder / "r/report.html");
    for (const char* fact : {"matched", "not_requested", "worst_case", "yielding", "making", "carries_over"}) {
        const std::string text = summary[fact];
        INFO(fact << ": " << text);
        CHECK_THAT(ended.out, Catch::Contains(text));
        CHECK_THAT(page, Catch::Contains(text.substr(0, 20)));
    }
    CHECK_THAT(summary["not_requested"].get<std::string>(), Catch::Contains("interface stiffness was not requested"));
    CHECK_THAT(summary["carries_over"].get<std::string>(), Catch::Contains("only for this length and the datum"));
}

TEST_CASE("a design with noise or a hardness is found only if it holds under them") {
    const Folder folder;
    write_scan(folder);
    const auto verified = [&](const std::string& flags) {
        const Ended ended = rugosa("design --like scan.txt --nodes 128 --pipeline 'own 1 | score | refine lm 10' "
                                   "--quantity stiffness --pictures off --force --out r" +
                                       flags,
                                   folder.path());
        INFO(flags << ": " << ended.err << ended.out);
        CHECK(ended.code == (result_in(folder / "r")["summary"]["found"].get<bool>() ? 0 : 3));
        return result_in(folder / "r")["summary"];
    };
    const double calm_similarity = verified("")["lowest"];
    const std::string required = " --reach-similarity " + std::to_string(calm_similarity - 0.01);
    const json calm = verified(required + " --noise 1e-9 --hardness 1e3");
    CHECK(calm["found"] == true);
    CHECK_THAT(calm["yielding"].get<std::string>(), Catch::StartsWith("yes, the highest"));
    const json noisy = verified(required + " --noise 0.01");
    CHECK(noisy["found"] == false);
    CHECK(noisy["lowest"] < calm_similarity - 0.01);
    const json soft = verified(required + " --hardness 1e-3");
    CHECK(soft["found"] == false);
    CHECK_THAT(soft["yielding"].get<std::string>(), Catch::StartsWith("no, it yields"));
}
