#include "apps/experiments/solvers/chart.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>

using namespace app;
using rough::Index;
using rough::Solver;

namespace {

const ChartExtent small{{32, 64, 128}, {64}, {5}, {1e-3, 1e-6}, 2049, 10};

ChartSetting nested(Index nodes, int steps) { return {0, Solver::nested, nodes, steps}; }

/// What a chart has of a scene, besides the scene.
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

TEST_CASE("a curve measured against itself has no error, and one that is off by a tenth has that") {
    const ChartScene scene = chart_scenes().front();
    const ChartTruth truth = truth_of(scene, 0);
    rough::ContactCurve curve;
    for (Eigen::Index k = 1000; k < truth.displacement.size(); k += 1000) {
        rough::LoadStep step;
        step.displacement = truth.displacement[k];
        step.pressure = truth.pressure[k];
        step.tangent_stiffness = truth.stiffness[k];
        step.contact_fraction = truth.fraction[k];
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

TEST_CASE("a solver's error on the Hertz scene falls with the grid") {
    const ChartScene scene = chart_scenes().front();
    const ChartTruth truth = truth_of(scene, 0);
    const auto coarse = run_chart(scene, truth, nested(65, 10), 10);
    const auto fine = run_chart(scene, truth, nested(513, 10), 10);
    REQUIRE((coarse && fine));
    CHECK(coarse->outcome == Outcome::solved);
    CHECK(fine->error_pressure < coarse->error_pressure / 20);
    CHECK(fine->error_pressure > 0);
    CHECK(fine->error_contact < coarse->error_contact / 4);
}

TEST_CASE("no error is told of a grid that the reference does not resolve") {
    const ChartScene scene = chart_scenes().back();
    const ChartTruth truth = truth_of(scene, 2049);
    CHECK(run_chart(scene, truth, nested(512, 5), 10)->error_pressure > 0);
    CHECK(run_chart(scene, truth, nested(1024, 5), 10)->error_pressure == ChartRun::unknown);
}

TEST_CASE("a chart is planned from coarse grids to fine, and tries nothing twice") {
    for (const ChartExtent* extent : {&quick_extent(), &whole_extent()}) {
        const auto plan = chart_plan(*extent);
        for (std::size_t k = 1; k < plan.size(); ++k)
            CHECK(plan[k].nodes >= plan[k - 1].nodes);
        for (const Solver method : {Solver::nested, Solver::nnls})
            CHECK(std::count(plan.begin(), plan.end(), usual_setting(0, method, 512)) == 1);
        CHECK(std::set<ChartSetting>(plan.begin(), plan.end()).size() == plan.size());
    }
}

TEST_CASE("a chart without time left has the coarsest grid of every scene, and says what it left out") {
    std::vector<std::string> words;
    const ChartData data =
        charted(chart_scenes(), small,
                {0, 0, {}, [&](const ChartData&, const std::string& text) { words.push_back(text); }});
    REQUIRE(data.scenes.size() == 5);
    CHECK_FALSE(data.runs.empty());
    for (const ChartRun& run : data.runs)
        CHECK(run.setting.nodes == 32);
    for (std::size_t scene = 1; scene < 5; ++scene)
        CHECK(settings_of(data, scene) == settings_of(data, 0));
    CHECK(data.runs.size() + data.left_out.size() == 5 * chart_plan(small).size());
    for (const LeftOut& each : data.left_out) {
        CHECK(each.setting.nodes > 32);
        CHECK(each.why == LeftOutFor::time);
    }
    CHECK_THAT(left_out_in_a_line(data), Catch::Contains("nested from N = 64"));
    const nlohmann::json facts = chart_facts(data);
    CHECK(facts["left_out"][0]["why"] == "the chart's time was over");
    CHECK(facts["ended_early"]["nodes"] == 64);
    CHECK_THAT(words.back(), Catch::StartsWith(std::to_string(data.runs.size()) + " of "));
}

TEST_CASE("a chart with time tries its whole plan, with the same errors each time") {
    const std::vector<ChartScene> scenes{chart_scenes().front()};
    const ChartBounds bounds{1000, 0, {}, {}};
    const ChartData one = charted(scenes, small, bounds), other = charted(scenes, small, bounds);
    CHECK(one.left_out.empty());
    CHECK(left_out_in_a_line(one).empty());
    REQUIRE(one.runs.size() == chart_plan(small).size());
    REQUIRE(other.runs.size() == one.runs.size());
    for (std::size_t k = 0; k < one.runs.size(); ++k) {
        CHECK(one.runs[k].setting == chart_plan(small)[k]);
        CHECK(one.runs[k].error_pressure == other.runs[k].error_pressure);
        CHECK(one.runs[k].error_stiffness == other.runs[k].error_stiffness);
        CHECK(one.runs[k].iterations == other.runs[k].iterations);
    }
}

TEST_CASE("a method that was too slow on a grid is not tried on finer ones, and this is reported") {
    ChartExtent impatient = small;
    impatient.limit = 0;
    const ChartData data = charted({chart_scenes().front()}, impatient, {1000, 0, {}, {}});
    for (const ChartRun& run : data.runs) {
        CHECK(run.outcome == Outcome::not_converged);
        CHECK(run.late);
        ChartSetting coarser = run.setting;
        coarser.nodes = 32;
        CHECK((run.setting == coarser || run.setting.steps == 5)); // the first grid with other steps
        CHECK(run.setting.nodes <= 64);
    }
    CHECK_FALSE(data.left_out.empty());
    for (const LeftOut& each : data.left_out)
        CHECK(each.why == LeftOutFor::limit);
    CHECK_THAT(chart_facts(data)["left_out"].dump(), Catch::Contains("one curve takes more than 0 s"));
}

TEST_CASE("an interrupted chart keeps what there is") {
    int solved = 0;
    const ChartData data = charted(chart_scenes(), small,
                                   {1000, 0, [&] { return solved >= 12; },
                                    [&](const ChartData& so_far, const std::string&) {
                                        solved = static_cast<int>(so_far.runs.size());
                                    }});
    CHECK(data.runs.size() == 12);
    CHECK(data.runs.size() + data.left_out.size() == 5 * chart_plan(small).size());
    for (const LeftOut& each : data.left_out)
        CHECK(each.why == LeftOutFor::interrupt);
    CHECK_THAT(left_out_in_a_line(data), Catch::Contains("(interrupted)"));
}

TEST_CASE("a chart's facts name the fastest method, and its table has one row per run") {
    ChartData data;
    const ChartScene scene = chart_scenes().front();
    data.scenes.push_back({scene.name, scene.words, "free", "the exact solution"});
    const ChartTruth truth = truth_of(scene, 0);
    for (const Index nodes : {64, 512})
        for (const auto method : {Solver::nested, Solver::nnls})
            data.runs.push_back(*run_chart(scene, truth, usual_setting(0, method, nodes), 10));
    const std::string table = chart_table(data).text();
    CHECK(
        table.rfind(
            "scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
            "iterations,outcome\nhertz,free,nested,64,20,0,",
            0) == 0);
    CHECK(std::count(table.begin(), table.end(), '\n') == 5);
    for (const ChartRun& run : data.runs)
        CHECK(data.at(run.setting) == &run);
    CHECK(data.at(nested(4096, 20)) == nullptr);
    CHECK(data.contact(0) == data.at(nested(512, 20))->contact_fraction);
    CHECK(data.contact(1) == 0);
    const nlohmann::json facts = chart_facts(data);
    CHECK(facts["fastest_by_grid"]["rows"].size() == 1);
    CHECK(facts["fastest_by_grid"]["rows"][0]["cells"][0]["method"] != "");
    CHECK_FALSE(facts.contains("ended_early"));
    CHECK(facts["failures"].empty());
    CHECK(chart_facts(
              {data.scenes, {}, {}, 1, {}})["fastest_by_pressure_error"]["rows"][0]["cells"][0]["method"] ==
          "");
    // The runs that no other beats: the error falls as the time grows.
    double error = HUGE_VAL;
    const auto points = points_table(data);
    for (const nlohmann::json& point : points.rows())
        if (point["kind"] == "pressure" && point["best"] == 2) {
            CHECK(point["error"] < error);
            error = point["error"];
        }
    CHECK(error < HUGE_VAL);
}

TEST_CASE("rugosa chart ends in time, complete over its scenes, and says in one line what it left out") {
    const app::testing::Folder folder;
    const auto ended = app::testing::rugosa("chart --quick --minutes 1e-9 --out r", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    CHECK_THAT(ended.out, Catch::Contains("left out: "));
    CHECK(std::count(ended.out.begin(), ended.out.end(), '\n') == 1);
    std::istringstream table(rough::read_whole(folder / "r" / "chart.csv"));
    std::map<std::string, int> rows;
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line))
        ++rows[line.substr(0, line.find(','))];
    CHECK(rows.size() == 8);
    for (const auto& [scene, count] : rows)
        if (scene == "self-affine-line")
            CHECK(count == 4); // Persson's theory and three grids
        else if (scene.ends_with("-map"))
            CHECK(count == 7); // three theories, two lines, two coarser grids
        else
            CHECK(count == 7); // auto, nested, NNLS and two tolerances of the iterative methods
    const std::string page = rough::read_whole(folder / "r" / "chart.html");
    for (const char* words :
         {"<b>If in doubt, use auto</b>", "on ground-map", "Contact fractions between which"})
        CHECK_THAT(page, Catch::Contains(words));
    CHECK_THAT(page, Catch::Contains("<b>This chart ended early</b>") && !Catch::Contains("No picture"));
    const auto parts = app::testing::outline(page);
    for (const char* figure : {"models", "theories", "pressure", "stiffness", "contact", "time"})
        CHECK(std::count(parts.begin(), parts.end(), "figure " + std::string(figure)) == 1);
    CHECK(std::filesystem::exists(folder / "r" / "chart.html"));
    CHECK(app::testing::result_in(folder / "r")["runs"].size() == 35 + 18);
}

TEST_CASE("models err as they must: lines are exact on ridges alone, theories where they hold") {
    const ModelChart chart = charted_models(64);
    REQUIRE(chart.scenes.size() == 3);
    for (const ModelRun& run : chart.runs) {
        const ModelScene& scene = chart.scenes[run.scene];
        const auto [area, stiffness] = errors_of(run, scene);
        INFO(scene.name << ", " << run.model << " " << run.nodes << ": " << area << ", " << stiffness);
        CHECK(run.seconds > 0);
        if (run.model == "persson")
            CHECK(area < (scene.name == "ground-map" ? 0.6 : 0.5));
        if (run.model == "mean-line" && scene.name == "self-affine-map")
            CHECK(area > 0.3); // the mean of every direction's waves is nearly flat
    }
    CHECK(chart.scenes[1].aspect_ratio > 0.5);
    CHECK(chart.scenes[2].aspect_ratio < 0.2);
    Eigen::Vector3d errors(3, NAN, -4);
    CHECK(root_mean_square(errors) == Approx(std::sqrt(12.5)));
    int looked_at = 0;
    const ModelChart none = charted_models(64, [&] { return ++looked_at > 0; });
    CHECK(none.runs.empty());
    CHECK(models_table(chart).rows().size() == 12 * chart.runs.size());
}

TEST_CASE("a chart's table grows as it is measured: what was there is kept when the program is killed") {
    const app::testing::Folder folder;
    const std::string script =
        folder
            .write(
                "kill.sh",
                "cd '" + folder.path().string() +
                    "'\n'" RUGOSA_PROGRAM "' chart --quick --minutes 1 --out r >log 2>&1 & child=$!\n"
                    "until grep -qs hertz r/chart.csv; do sleep 0.02; done\nkill -KILL $child; wait $child\n")
            .string();
    CHECK(WEXITSTATUS(std::system(("bash '" + script + "' 2>/dev/null").c_str())) == app::testing::killed);
    const std::string table = rough::read_whole(folder / "r" / "chart.csv");
    CHECK_THAT(table, Catch::Contains("\nhertz,"));
    CHECK_THAT(table, !Catch::Contains("\nfractional-brownian,free,nested,2048,")); // whose turn is last
}

TEST_CASE("rugosa chart refuses a folder that holds a chart") {
    const app::testing::Folder folder;
    folder.write("chart.csv", "x");
    const auto ended = app::testing::rugosa("chart --quick --out .", folder.path());
    CHECK(ended.code == 2);
    CHECK(ended.error_lines() == 1);
}
