#include "experiments/chart/chart.hpp"
#include "tests/apps/results.hpp"

using namespace app;
using rough::Index;
using rough::Solver;

namespace {

const ChartExtent small_extent{{32, 64, 128}, {64}, {5}, {1e-3, 1e-6}, 2049, 10};

/// The settings of a chart's runs on a scene, all with scene 0.
std::set<ChartSetting> settings_of(const ChartData& data, std::size_t scene) {
    std::set<ChartSetting> settings;
    for (const ChartRun& run : data.runs)
        if (ChartSetting setting = run.setting; setting.scene == scene) {
            setting.scene = 0;
            settings.insert(setting);
        }
    return settings;
}

} // namespace

TEST_CASE("a curve measured against itself has no error, and a tenth more gives that error") {
    const ChartScene scene = chart_scenes().front();
    const ChartTruth truth = truth_of(scene, 0);
    rough::ContactCurve curve;
    for (Eigen::Index k = 1000; k < truth.displacement.size(); k += 1000) {
        rough::LoadStep step;
        step.displacement = truth.displacement[k];
        step.pressure = truth.pressure[k];
        step.tangent_stiffness = truth.tangent_stiffness[k];
        step.contact_fraction = truth.contact_fraction[k];
        curve.steps.push_back(step);
    }
    ChartRun run;
    measure_errors(curve, truth, run);
    CHECK(run.error_pressure < 1e-12);
    CHECK(run.error_contact < 1e-12);
    CHECK(run.error_stiffness < 1e-3); // K is curved between the steps
    for (rough::LoadStep& step : curve.steps) {
        step.pressure *= 1.1;
        step.contact_fraction += 0.02;
    }
    measure_errors(curve, truth, run);
    CHECK(run.error_pressure == Approx(0.1));
    CHECK(run.error_contact == Approx(0.02));
}

TEST_CASE("a chart without time left has the coarsest grid of every scene, and says what it left out") {
    std::vector<std::string> words;
    const ChartData data = charted(chart_scenes(), small_extent, 0, never,
                                   [&](const ChartData&, const std::string& text) { words.push_back(text); });
    REQUIRE(data.scenes.size() == 5);
    CHECK_FALSE(data.runs.empty());
    for (const ChartRun& run : data.runs)
        CHECK(run.setting.nodes == 32);
    for (std::size_t scene = 1; scene < 5; ++scene)
        CHECK(settings_of(data, scene) == settings_of(data, 0));
    CHECK(data.runs.size() + data.left_out.size() == 5 * chart_plan(small_extent).size());
    for (const LeftOut& each : data.left_out) {
        CHECK(each.setting.nodes > 32);
        CHECK(each.why == time_over);
    }
    const Findings found = findings_of(data);
    CHECK_THAT(found.summary, Catch::Contains("nested from N = 64"));
    const nlohmann::json& facts = found.result;
    CHECK(facts["left_out"][0]["why"] == "the chart's time was over");
    CHECK(facts["ended_early"]["nodes"] == 64);
    CHECK_THAT(words.back(), Catch::StartsWith(std::to_string(data.runs.size()) + " of "));
}

TEST_CASE("rugosa chart ends in time, and its line and page report the settings that were left out") {
    const app::testing::Folder folder;
    const auto ended = app::testing::rugosa("chart --quick --minutes 1e-9 --out r", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    CHECK_THAT(ended.out, Catch::Contains("left out: "));
    CHECK(std::ranges::count(ended.out, '\n') == 1);
    const std::string page = rough::read_whole(folder / "r" / "chart.html");
    CHECK(page.find("No picture") == std::string::npos);
    CHECK(app::testing::found(page, "<figure id=\"([^\"]*)\"").size() == 6);
    // Seven settings of five solver scenes; four models of the line, seven of each map.
    CHECK(app::testing::result_in(folder / "r")["runs"].size() == 5 * 7 + 4 + 2 * 7);
}

TEST_CASE("errors of theories and lines have the expected size on each scene") {
    ChartData data;
    chart_models(data, 64);
    const nlohmann::json& runs = data.models.tables.at("model_errors.csv").rows();
    for (const nlohmann::json& run : runs) {
        INFO(run);
        const double error = run["area"];
        CHECK(run["seconds"] > 0);
        if (run["model"] == "persson")
            CHECK(error < (run["scene"] == "ground-map" ? 0.6 : 0.5));
        if (run["model"] == "mean-line" && run["scene"] == "self-affine-map")
            CHECK(error > 0.3); // the mean of every direction's waves is nearly flat
    }
    const Findings found = findings_of(data);
    CHECK(found.result["model_scenes"].size() == 3);
    CHECK(found.result["lines"][0]["aspect_ratio"] > 0.5);
    CHECK(found.result["lines"][1]["aspect_ratio"] < 0.2);
    CHECK(found.result["runs"].size() == runs.size());
    CHECK(found.tables.at("models.csv").rows().size() == 12 * runs.size());
    Eigen::Vector3d errors(3, NAN, -4);
    CHECK(root_mean_square(errors) == Approx(std::sqrt(12.5)));
}

TEST_CASE("chart.csv has the measurements so far when the program is killed") {
    const app::testing::Folder folder;
    const auto ended = app::testing::disturbed("chart --quick --minutes 1 --out r", folder.path(),
                                               "grep -qs hertz r/chart.csv", "kill -KILL $child");
    CHECK(ended.code == app::testing::killed);
    const std::string table = rough::read_whole(folder / "r" / "chart.csv");
    CHECK_THAT(table, Catch::Contains("\nhertz,"));
    CHECK_THAT(table, !Catch::Contains("\nfractional-brownian,free,nested,2048,")); // the last scene
}
