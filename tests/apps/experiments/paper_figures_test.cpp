#include "apps/experiments/paper/figures.hpp"
#include "domain/mwm/waves.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

using namespace app;

namespace {

constexpr double L = 2;

rough::Response response() {
    rough::Response response;
    response.displacement = Eigen::Vector3d(1, 2, 3);
    response.pressure = Eigen::Vector3d(1, 3, 6);
    response.contact_fraction = Eigen::Vector3d(0.1, 0.3, 0.6);
    return response;
}

/// Both targets, each with the paper's three answers, of one, two and three waves.
PaperRun run_of_three() {
    PaperRun run;
    run.model.grid = {64, L, true};
    run.max_pressure = 6;
    for (const char* title : {"drawn", "held-out"}) {
        TargetRun target;
        target.title = title;
        target.target.x = Eigen::Vector2d(1, 4);
        target.target.y = Eigen::Vector2d(1, 2);
        rough::Genome genome{1, {{1, 0.8, 2, L, {}}}};
        for (const char* name : {"sog", "gco", "cco"}) {
            VariantRun variant;
            variant.name = name;
            genome.series[0].chromosomes.push_back(
                {static_cast<int>(genome.series[0].chromosomes.size()) + 1, {0.3}});
            variant.answer = {genome, response()};
            variant.stages = {{"score.1", {{0, {}, 0.7}, {1, {}, 0.8}}}, {"best.1", {{1, {}, 0.75}}}};
            target.variants.push_back(variant);
        }
        for (const double share : {0.07, 0.25})
            target.thresholds.push_back({.p_bar = 3, .variant = "gco", .share_above = share, .parents = {}});
        run.targets.push_back(target);
    }
    return run;
}

} // namespace

TEST_CASE("the answers' surfaces are drawn about their means, and their spectra wave by wave") {
    const PaperRun run = run_of_three();
    const Figure surfaces = profiles_figure(run), spectra = spectra_figure(run);
    REQUIRE(surfaces.panels.size() == 2);
    REQUIRE(spectra.panels.size() == 4); // discrete and continuous of each target
    CHECK(surfaces.panels[0].title == "Drawn target");
    CHECK(spectra.panels[0].x.from == Approx(0.8 * 2 * std::numbers::pi / L));
    for (std::size_t t = 0; t < 2; ++t) {
        REQUIRE(surfaces.panels[t].series.size() == 3);
        REQUIRE(spectra.panels[2 * t].series.size() == 3);
        for (std::size_t v = 0; v < 3; ++v) {
            const Series& surface = surfaces.panels[t].series[v];
            CHECK(surface.x.size() == 64);
            CHECK(surface.x[1] == Approx(run.model.grid.spacing()));
            CHECK(std::abs(surface.y.mean()) < 1e-12 * surface.y.cwiseAbs().maxCoeff());
            const auto lines = discrete_spectrum(run.targets[t].variants[v].answer.genome);
            const Series& powers = spectra.panels[2 * t].series[v];
            REQUIRE(powers.x.size() == static_cast<rough::Index>(lines.size()));
            CHECK(powers.x[0] == lines[0].wave_number);
            CHECK(powers.y[0] == lines[0].power);
        }
    }
}

TEST_CASE("what is best so far is drawn stage by stage, and every threshold's share has room") {
    const PaperRun run = run_of_three();
    const Figure way = convergence_figure(run), thresholds = thresholds_figure(run),
                 stages = stages_figure(run);
    REQUIRE(way.panels.size() == 2);
    for (const Plot& plot : way.panels) {
        REQUIRE(plot.series.size() == 3);
        for (const Series& series : plot.series)
            CHECK(series.y == Eigen::Vector2d(0.8, 0.8));
    }
    CHECK(std::count_if(thresholds.panels.begin(), thresholds.panels.end(),
                        [](const Plot& plot) { return plot.y.to == 30; }) == 2); // per cent
    CHECK(stages.panels.size() == 6);
    for (const Plot& plot : stages.panels) // no refinement is under 0.95
        CHECK(plot.y.from == Approx(0.95));
}

TEST_CASE("candidates are drawn from before the refinements to behind both") {
    PaperRun run = run_of_three();
    for (TargetRun& target : run.targets)
        for (VariantRun& variant : target.variants)
            variant.stages = {
                {"score.1", {{4, {}, 0.7}}}, {"refine.1", {{4, {}, 0.8}}}, {"refine.2", {{4, {}, 0.9}}}};
    for (const Plot& plot : stages_figure(run).panels) {
        REQUIRE(plot.series.size() == 1);
        CHECK(plot.series[0].label == "no. 4");
        CHECK(plot.series[0].y == Eigen::Vector3d(0.7, 0.8, 0.9));
    }
}

TEST_CASE("both targets stand among the database's curves") {
    PaperRun run = run_of_three();
    run.database.push_back(run.targets[0].variants[0].answer);
    const Figure figure = database_figure(run);
    REQUIRE(figure.panels.size() == 1);
    const auto& series = figure.panels[0].series;
    REQUIRE(series.size() == 3);
    CHECK(series[1].label == "drawn target");
    CHECK(series[2].label == "held-out target");
    CHECK(series[1].y == run.targets[0].target.y);
}

TEST_CASE("shares of phase sets are drawn in per cent against the number of ridges") {
    const Figure figure = ridges_figure({{2, 1, 0.9, 0.5}, {8, 1, 0.95, 0.45}});
    const auto& series = figure.panels.at(0).series;
    REQUIRE(series.size() == 3);
    for (const Series& each : series)
        CHECK(each.x == Eigen::Vector2d(2, 8));
    CHECK(series[0].y.isApprox(Eigen::Vector2d(100, 100)));
    CHECK(series[1].y.isApprox(Eigen::Vector2d(90, 95)));
    CHECK(series[2].y.isApprox(Eigen::Vector2d(50, 45)));
    const auto says = [](const Figure& one) { return one.caption.markup(); };
    CHECK_THAT(says(figure), Catch::Contains(" for M = 2 to 8."));
    CHECK_THAT(says(ridges_figure({{2, 1, 0.8, 0.5}, {8, 1, 0.99, 0.5}})),
               Catch::Contains(" for no M tried."));
}

TEST_CASE("a fractal profile and its dominant bands are drawn node by node over the length") {
    FractalStudy study;
    study.whole = {Eigen::Vector4d(0, 2e-3, -1e-3, 0), 0.5};
    study.reduced = {Eigen::Vector4d(0, 1e-3, -1e-3, 0), 0.5};
    study.whole_response = study.reduced_response = response();
    study.bands.resize(2);
    study.bands[0].longest = 2, study.bands[0].shortest = 1;
    study.bands[1].longest = 0.5, study.bands[1].shortest = 0.25;
    study.dominant = {true, false};
    const Figure figure = fractal_figure(study);
    REQUIRE(figure.panels.size() == 3);
    const Plot& heights = figure.panels[0];
    CHECK(heights.x.to == 1.5);
    REQUIRE(heights.series.size() == 2);
    CHECK(heights.series[0].x.isApprox(Eigen::Vector4d(0, 0.5, 1, 1.5)));
    CHECK(heights.series[0].y.isApprox(Eigen::Vector4d(0, 2, -1, 0)));
    CHECK(heights.y.label.find("µm") != std::string::npos);
    CHECK_THAT(figure.caption.markup(), Catch::Contains("keeps 1 of 2 (1.0–2.0 mm)."));
}
