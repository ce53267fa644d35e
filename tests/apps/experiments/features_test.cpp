#include "apps/experiments/features/run.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/problem/problem.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace app;
using app::testing::Ended;
using app::testing::Folder;
using app::testing::result_in;
using app::testing::rugosa;
using nlohmann::json;

namespace {

double value(const std::vector<SurfaceFeature>& features, const std::string& name) {
    for (const SurfaceFeature& feature : features)
        if (feature.name == name)
            return feature.value;
    FAIL("no feature " << name);
    return 0;
}

rough::Model coarse() {
    rough::Model model;
    model.grid = {129, 2};
    return completed(model);
}

FeatureSample sample_with(double feature, double stiffness) {
    FeatureSample sample;
    sample.features = {{"f", "", feature}, {"waves g", "", std::sin(50 * stiffness)}};
    sample.stiffness = {stiffness, stiffness, stiffness};
    return sample;
}

} // namespace

TEST_CASE("features of one cosine are the cosine's, whatever its amplitude and side") {
    const double lambda = 2;
    const auto cosine = [&](double phase, double scale) {
        return features_of({scale, {{1, 0.8, 1.5, lambda, {{1, {phase}}}}}}, coarse());
    };
    const auto hill = cosine(std::numbers::pi, 1e-3); // the top at the ends
    CHECK(value(hill, "highest peak") == Approx(0.5));
    CHECK(value(hill, "deepest valley") == Approx(0).margin(1e-9));
    CHECK(value(hill, "mean depth") == Approx(0.5).epsilon(0.02));
    CHECK(value(hill, "Rq") == Approx(1 / std::sqrt(8.)).epsilon(0.02));
    CHECK(value(hill, "bearing 50 %") == Approx(0.5).epsilon(0.02));
    CHECK(value(hill, "slope") == Approx(std::log10(std::numbers::pi / std::sqrt(2.))).margin(0.02));
    CHECK(value(hill, "waves about L and longer") == Approx(0).margin(1e-12));
    CHECK(value(hill, "spots at 50 % of the approach") == Approx(std::log10(2.)));
    const auto higher = cosine(std::numbers::pi, 7e-3);
    for (std::size_t f = 0; f < hill.size(); ++f)
        CHECK(higher[f].value == Approx(hill[f].value).margin(1e-9));
    const auto left = cosine(2.2, 1e-3), right = cosine(-2.2, 1e-3);
    for (std::size_t f = 0; f < left.size(); ++f)
        CHECK(left[f].value == Approx(right[f].value).margin(1e-6));
}

TEST_CASE("a wave belongs to the octave that its length is nearest to") {
    CHECK(wave_octave(2, 2) == 0);
    CHECK(wave_octave(8, 2) == 0);
    CHECK(wave_octave(1.1, 2) == 1);
    CHECK(wave_octave(0.5, 2) == 2);
    CHECK(wave_octave(1e-6, 2) == wave_octaves - 1);
}

TEST_CASE("a regression tells what a linear law leaves out, and nothing of noise") {
    ga::Stream random(3);
    Eigen::MatrixXd columns(200, 2);
    for (Eigen::Index i = 0; i < columns.size(); ++i)
        columns(i) = random.normal();
    CHECK(left_out_r2(columns, 3 * columns.col(0) - columns.col(1)) > 0.999);
    Eigen::VectorXd noise(200);
    for (double& one : noise)
        one = random.normal();
    CHECK(left_out_r2(columns, noise) < 0.1);
    CHECK(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}) == Approx(1));
    CHECK(rank_correlation({1, 2, 3}, {3, 2, 1}) == Approx(-1));
}

TEST_CASE(
    "a feature is shared where answers lie closer than misses, shifted where they lie aside, else open") {
    ga::Stream random(5);
    const auto kind = [&](double at, double spread) {
        FeatureTarget target;
        for (int i = 0; i < 300; ++i) {
            target.answers.push_back(sample_with(at + spread * random.normal(), random.normal()));
            target.misses.push_back(sample_with(random.normal(), random.normal()));
        }
        judge_features(target);
        return target.verdicts[0].kind;
    };
    CHECK(kind(0, 0.1) == FeatureVerdict::Kind::shared);
    CHECK(kind(2, 1) == FeatureVerdict::Kind::shifted);
    CHECK(kind(0, 1) == FeatureVerdict::Kind::open);
}

TEST_CASE("answers of the features experiment are as similar as they are said to be, and differ") {
    const Folder folder;
    const std::string words =
        "run '" RUGOSA_SOURCE "/experiments/features.ini' --pictures off --nodes 64 --steps 8 --set "
        "features.answers=6 --set features.similarity=0.9 --set features.held-out=8 --set "
        "targets.files='" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --out ";
    const Ended ended = rugosa(words + "r", folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    rough::DesignSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.loading.steps = 8;
    setup.model = completed(setup.model);
    setup.targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    setup.max_pressure = 1.6e-4;
    const json genomes = json::parse(rough::read_whole(folder / "r/genomes.json"));
    REQUIRE(genomes.size() == 12);
    for (const json& one : genomes) {
        const double s = similarity(setup, rough::genome_from_json(one["genome"], "genome"));
        CHECK(s == Approx(one["similarity"].get<double>()).margin(1e-9));
        CHECK((s >= 0.9) == (one["group"] == "answer"));
    }
    CHECK(result_in(folder / "r")["targets"]["drawn"]["answers"] == 6);
    REQUIRE(rugosa(words + "one --threads 1", folder.path()).code == 0);
    CHECK(rough::read_whole(folder / "r/surfaces.csv") == rough::read_whole(folder / "one/surfaces.csv"));
}
