#include "experiments/chart/chart.hpp"
#include "tests/apps/results.hpp"

using namespace app;

namespace {

/// Results on a scene with made-up runs: side, seconds, errors of both kinds, further words of the setting.
struct MadeUp {
    ChartData data;
    explicit MadeUp(double floor) {
        static const ChartScene scene = chart_scenes().front();
        data.scenes = {scene};
        data.references.resize(1);
        data.references[0].floor_stiffness = data.references[0].floor_contact = floor;
        data.references[0].curve.contact_fraction = Eigen::VectorXd::Constant(14, 0.5);
    }
    ChartRun& add(Eigen::Index side, double seconds, double error, const std::string& method = "auto",
                  const std::string& family = "map") {
        ChartRun run;
        run.setting = {0, family, method, side};
        run.seconds = seconds;
        run.error_stiffness = run.error_contact = error;
        run.answered = 9;
        data.runs.push_back(run);
        return data.runs.back();
    }
    std::string words() const { return findings_of(data).result["scenes"][0]["stiffness"]; }
};

} // namespace

TEST_CASE("the error beyond the finest of three grids is the sum of a geometric series") {
    CHECK(remaining_error(0.5, 0.25, 0.25) == Approx(0.25)); // errors of 1, 1/2 and 1/4
    CHECK(remaining_error(0.1, 0.2, 0.25) == Approx(0.6));   // changes that do not shrink
    CHECK(remaining_error(1, 0.01, 0.25) == Approx(0.01 / 3));
    CHECK(remaining_error(0, 0, 0.25) == 0);
}

TEST_CASE("an error is measured with the reference's, and a load without an answer counts as 100 %") {
    const ChartScene scene = chart_scenes().back(); // westergaard, exact
    ChartReference reference;
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(9);
    reference.curve = {ones, ones, ones};
    reference.floor_stiffness = 0.02;
    ChartRun run;
    run.curve = reference.curve;
    measure_errors(scene, reference, run);
    CHECK(run.error_stiffness == Approx(0.02));
    CHECK(run.error_contact == 0);
    run.curve.contact_fraction *= 1.1;
    run.curve.stiffness[3] = NAN;
    measure_errors(scene, reference, run);
    CHECK(run.error_contact == Approx(0.1));
    CHECK(run.error_stiffness == Approx(0.02 + 1.0 / 3));
    CHECK(run.answered == 8);
}

TEST_CASE("grids agree better with an exact solution the finer they are") {
    const std::vector<ChartScene> scenes = chart_scenes();
    for (const std::size_t s : {6, 7}) { // hertz and westergaard
        const ChartReference reference = exact_reference(scenes[s]);
        double last = HUGE_VAL;
        for (const Eigen::Index side : {128, 512, 2048}) {
            const ChartRun run = run_chart(scenes[s], reference, {s, "profile", "nested", side});
            CHECK(run.error_stiffness < 0.5 * last);
            last = run.error_stiffness;
        }
        CHECK(last < 0.003);
    }
}

TEST_CASE("the chart's advice claims only what was measured") {
    MadeUp usual(0.001);
    usual.add(32, 1e-3, 0.12);
    usual.add(64, 9e-3, 0.04);
    usual.add(64, 7e-3, 0.04, "nested"); // not much faster than the default
    usual.add(128, 5e-2, 0.008);
    CHECK(usual.words() ==
          "For 5 % error in the stiffness K, take a map of 64 x 64 cells: 9 ms; for less than 1 %, a "
          "map of 128 x 128 cells: 50 ms. Within ten times the time of the first the error falls from 4 % "
          "to 0.8 %.");
    MadeUp poor(0.03);
    poor.add(32, 1e-3, 0.12);
    CHECK(poor.words() ==
          "Nothing that was measured has an error of 5 % or less in the stiffness K; the lowest is 12 % "
          "with a map of 32 x 32 cells: 1 ms.");
    poor.add(64, 1e-2, 0.045);
    CHECK_THAT(poor.words(), Catch::Contains("below 1 % nothing is claimed, because the reference itself may be off by "
                                             "3 %.") &&
                                 Catch::Contains("the error does not fall."));
    MadeUp good(0);
    good.add(128, 2e-4, 0.004, "persson", "theory");
    CHECK(good.words() == "For 5 % error in the stiffness K, take Persson's theory: 200 µs, which also has an error "
                          "below 1 % (0.4 %).");
    good.data.runs[0].outcome = Outcome::refused;
    good.data.runs[0].message = "because";
    good.add(32, 1e-3, 0.02);
    CHECK_THAT(good.words(),
               Catch::StartsWith("For 5 % error in the stiffness K, take a map of 32 x 32 cells: 1 ms; less "
                                 "than 1 % was not reached"));
    CHECK(findings_of(good.data).result["failures"][0]["message"] == "because");
}

TEST_CASE("labels of a chart cover neither dots nor each other") {
    MadeUp crowd(0.001);
    for (int i = 0; i < 25; ++i)
        crowd.add(32 + i, 1e-2 * std::pow(1.1, i % 7), 0.05 * std::pow(1.2, i % 5), "active-set");
    crowd.add(32, 1e-4, 20);
    const Findings found = findings_of(crowd.data);
    const nlohmann::json& axes = found.tables.at("axes.csv").rows()[0];
    const auto pixel = [&](const char* axis, const nlohmann::json& value, double size) {
        const double from = std::log(axes[std::string(axis) + "_from"].get<double>()),
                     to = std::log(axes[std::string(axis) + "_to"].get<double>());
        return (std::log(value.get<double>()) - from) / (to - from) * size;
    };
    std::vector<std::array<double, 4>> boxes; // left, right, low, high
    for (const nlohmann::json& row : found.tables.at("points.csv").rows())
        if (row["kind"] == "stiffness") {
            const double x = pixel("seconds", row["label_seconds"], 410), y = pixel("error", row["label_error"], 424),
                         wide = 6.8 * static_cast<double>(row["label"].get<std::string>().size()),
                         dot_x = pixel("seconds", row["seconds"], 410), dot_y = pixel("error", row["error"], 424);
            boxes.push_back(
                {row["label_left"] == 1 ? x : x - wide, row["label_left"] == 1 ? x + wide : x, y - 6, y + 6});
            boxes.push_back({dot_x, dot_x, dot_y, dot_y});
            CHECK(row["label"].get<std::string>().find(',') == std::string::npos);
        }
    REQUIRE(boxes.size() == 52);
    for (std::size_t i = 0; i < boxes.size(); i += 2) {
        CHECK(boxes[i][0] >= 0);
        CHECK(boxes[i][1] <= 410);
        for (std::size_t j = 0; j < boxes.size(); ++j)
            CHECK((i == j || boxes[i][0] >= boxes[j][1] || boxes[j][0] >= boxes[i][1] || boxes[i][2] >= boxes[j][3] ||
                   boxes[j][2] >= boxes[i][3]));
    }
}

TEST_CASE("rugosa chart ends in time, and its page has only what was measured") {
    const app::testing::Folder folder;
    const auto ended = app::testing::rugosa("chart --set chart.quick=on --minutes 1e-9 --out r", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    CHECK_THAT(ended.out, Catch::Contains("settings were not measured"));
    CHECK(std::ranges::count(ended.out, '\n') == 1);
    const std::string page = rough::read_whole(folder / "r" / "chart.html");
    CHECK(page.find("No picture") == std::string::npos);
    CHECK(page.find("because\nthe time was over") != std::string::npos);
    CHECK(page.find("hertz") == std::string::npos);
    CHECK(app::testing::result_in(folder / "r")["runs"].size() == 1);
    const auto refused = app::testing::rugosa("chart --set chart.quik=on --out s", folder.path());
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("--set: unknown key 'chart.quik'") && Catch::Contains("chart.quick"));
}

TEST_CASE("chart.csv has the measurements so far when the program is killed") {
    const app::testing::Folder folder;
    const auto ended =
        app::testing::disturbed("chart --quick --out r", folder.path(), "[ -s r/chart.csv ]", "kill -KILL $child");
    CHECK(ended.code == app::testing::killed);
    const auto rows = app::csv_rows(rough::read_whole(folder / "r" / "chart.csv"));
    CHECK(rows.size() > 1);
    CHECK(std::ranges::none_of(
        rows, [](const auto& row) { return row[0] == "hertz" && row[3] == "16384"; })); // the finest grid
    for (const auto& row : rows) CHECK(row.size() == rows[0].size());
    CHECK_FALSE(exists(folder / "r" / "chart.html"));
}
