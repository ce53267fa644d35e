#include "apps/chart_page.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app;

TEST_CASE("a curve measured against itself has no error, and one that is off by a tenth has that") {
    const ChartScene scene = chart_scenes().front();
    const ChartTruth truth = truth_of(scene, 0);
    rough::ContactCurve curve;
    for (Eigen::Index k = 100; k < truth.displacement.size(); k += 100) {
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
    const ChartRun coarse = run_chart(scene, &truth, rough::Solver::nested, 65, 10, 0, 10);
    const ChartRun fine = run_chart(scene, &truth, rough::Solver::nested, 513, 10, 0, 10);
    CHECK(coarse.outcome == Outcome::solved);
    CHECK(fine.error_pressure < coarse.error_pressure / 20);
    CHECK(fine.error_pressure > 0);
    CHECK(fine.error_contact < coarse.error_contact / 4);
}

TEST_CASE("the growth of cost is fitted as a power of nodes and contact fraction") {
    std::vector<ChartRun> runs;
    for (const rough::Index nodes : {100, 1000, 5000})
        for (const double fraction : {0.1, 0.3}) {
            ChartRun run;
            run.method = "nested";
            run.nodes = nodes;
            run.contact_fraction = fraction;
            run.seconds = 2e-9 * std::pow(nodes, 2.5) * std::pow(fraction, 1.5);
            runs.push_back(run);
        }
    const Growth growth = fitted_growth("nested", runs);
    CHECK(growth.factor == Approx(2e-9));
    CHECK(growth.by_nodes == Approx(2.5));
    CHECK(growth.by_contact == Approx(1.5));
    CHECK(fitted_growth("nnls", runs).factor == 0);
}

TEST_CASE("the chart's page says which method to take, and its table has a row a run") {
    ChartData data;
    data.scenes.emplace_back("hertz", "a parabola");
    const ChartScene scene = chart_scenes().front();
    const ChartTruth truth = truth_of(scene, 0);
    for (const rough::Index nodes : {64, 512})
        for (const auto method : {rough::Solver::nested, rough::Solver::nnls})
            data.runs.push_back(run_chart(scene, &truth, method, nodes, 10, 0, 10));
    const std::string table = chart_csv(data.runs);
    CHECK(
        table.rfind(
            "scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
            "iterations,outcome\n",
            0) == 0);
    CHECK(std::count(table.begin(), table.end(), '\n') == 5);
    const std::string page = chart_page(data);
    CHECK_THAT(page, Catch::Contains("<b>Take nested</b>"));
    CHECK_THAT(page, Catch::Contains("At N = 512 nnls takes"));
    CHECK_THAT(page, Catch::Contains("<svg"));
}

TEST_CASE("rugosa chart refuses a folder that holds a chart") {
    const app::testing::Folder folder;
    folder.write("chart.csv", "x");
    const auto ended = app::testing::rugosa("chart --quick --out .", folder.path());
    CHECK(ended.code == 2);
    CHECK(ended.error_lines() == 1);
}
