#include "apps/experiments/features/run.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/problem.hpp"
#include "domain/profile/profile.hpp"
#include "tests/apps/experiments/finished.hpp"

#include <numbers>

using namespace app;
using app::testing::Folder;
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
    sample.features = {feature, std::sin(50 * stiffness)};
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
    CHECK(value(hill, "peaks' distance") == Approx(1)); // from end to end
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
    CHECK(left_out(columns, 3 * columns.col(0) - columns.col(1)).error < 0.05); // a little for the ridge
    Eigen::VectorXd noise(200);
    for (double& one : noise)
        one = random.normal();
    const Foretold nothing = left_out(columns, noise);
    CHECK(nothing.error > 0.95 * nothing.of_mean);
    CHECK(nothing.of_mean == Approx(1).epsilon(0.2)); // the noise's own deviation
    CHECK(std::isnan(left_out(columns.topRows(9), noise.head(9)).error));
    // A row that its own law has seen would be foretold: as many columns as rows.
    Eigen::MatrixXd own = Eigen::MatrixXd::Identity(50, 50) * 1e6;
    CHECK(left_out(own, noise.head(50)).error > 0.9);
    CHECK(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}) == Approx(1));
    CHECK(rank_correlation({1, 2, 3}, {3, 2, 1}) == Approx(-1));
}

TEST_CASE(
    "a feature is shared where answers lie closer than misses, shifted where they lie aside, else open") {
    ga::Stream random(5);
    FeatureTarget target;
    const auto kind = [&](double at, double spread) {
        target = {};
        target.features = {{"f", "", 0}, {"waves g", "", 0}};
        for (int i = 0; i < 300; ++i) {
            target.answers.push_back(sample_with(at + spread * random.normal(), random.normal()));
            target.misses.push_back(sample_with(random.normal(), random.normal()));
        }
        assess_features(target);
        for (const json& one : target.verdicts)
            if (one["feature"] == "f")
                return one["kind"].get<std::string>();
        return std::string("none");
    };
    CHECK(kind(0, 0.1) == "shared");
    for (const json& one : target.verdicts) // 1.349 deviations lie between a normal's quartiles
        if (one["feature"] == "f") {
            CHECK(one["answers_quartiles"].get<double>() == Approx(0.1349).epsilon(0.15));
            CHECK(one["misses_quartiles"].get<double>() == Approx(1.349).epsilon(0.15));
        }
    CHECK(target.verdicts[0]["feature"] == "f");
    CHECK(target.laws.size() == 3 * 3); // of all, of the shared one, of waves
    CHECK(kind(2, 1) == "shifted");
    CHECK(kind(0, 1) == "open");
    CHECK(target.laws.size() == 2 * 3); // none is shared
    // Answers have no part in what misses say of K.
    const json before = target.laws[0]["error"];
    for (FeatureSample& answer : target.answers)
        answer.stiffness.fill(100);
    assess_features(target);
    CHECK(target.laws[0]["error"] == before);
}

TEST_CASE("waves are enough where a start loses little for sure, not enough where much, else it is open") {
    CHECK(whether_enough({-0.001, 0.005, 0.95}) == "the waves named are enough");
    CHECK(whether_enough({0.006, 0.02, 0.95}) == "the waves named are not enough");
    CHECK(whether_enough({-0.02, 0.02, 0.95}).find("so few starts do not decide") == 0);
    const rough::Interval loss = loss_of({0.9, 0.8, 0.99, 0.97}, {0.8, 0.9, 0.9, 0.9});
    CHECK(loss.lower == Approx(-0.1));
    CHECK(loss.upper == Approx(0.1));
}

TEST_CASE(
    "answers of the features experiment are as similar as they are said to be, differ, and are found again") {
    const Folder folder;
    const std::string words =
        "run '" RUGOSA_SOURCE "/experiments/features.ini' --pictures off --nodes 64 --steps 8 --set "
        "features.answers=40 --set features.similarity=0.9 --set features.held-out=8 --set "
        "targets.files='" RUGOSA_SOURCE "/experiments/targets/drawn.csv'";
    const json result = app::testing::finished(words, folder);
    rough::DesignSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.loading.steps = 8;
    setup.model = completed(setup.model);
    setup.targets = {rough::read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    setup.max_pressure = 1.6e-4;
    const json genomes = json::parse(rough::read_whole(folder / "r/genomes.json"));
    REQUIRE(genomes.size() == 80);
    std::vector<rough::Profile> answers;
    std::vector<std::vector<double>> felt(wave_octaves); // by each answer's phase that is felt most
    const rough::DesignProblem problem(setup);
    for (const json& one : genomes) {
        const auto genome = rough::genome_from_json(one["genome"], "genome");
        const double s = similarity(setup, genome);
        CHECK(s == Approx(one["similarity"].get<double>()).margin(1e-9));
        CHECK((s >= 0.9) == (one["group"] == "answer"));
        if (one["group"] != "answer")
            continue;
        answers.push_back(sample(genome, setup.model.grid));
        const auto jacobian = problem.sensitivity(genome, "similarity").jacobian;
        const auto places = rough::gene_places(genome);
        std::map<std::size_t, double> most;
        for (std::size_t g = 0; g < places.size(); ++g)
            if (places[g].kind == rough::GenePlace::Kind::phase) {
                const rough::Series& series = genome.series[places[g].series];
                double& octave =
                    most[wave_octave(wave_length(series, series.chromosomes[places[g].chromosome].n),
                                     setup.model.grid.length)];
                const auto column = jacobian.col(static_cast<Eigen::Index>(g));
                octave = std::max(octave, column.norm() / std::sqrt(static_cast<double>(column.size())));
            }
        for (const auto& [octave, size] : most)
            felt[octave].push_back(size);
    }
    std::istringstream octaves(rough::read_whole(folder / "r/octaves.csv"));
    int compared = 0;
    for (std::string line; std::getline(octaves, line);)
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            if (const std::string row = "drawn," + octave_name(octave) + ",";
                line.starts_with(row) && felt[octave].size() == answers.size()) {
                CHECK(std::stod(line.substr(row.size())) ==
                      Approx(rough::median(felt[octave])).epsilon(1e-6));
                ++compared;
            }
    CHECK(compared > 2);
    double least = 2;
    for (std::size_t i = 0; i < answers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, difference(answers[i], answers[j]));
    CHECK(least >= 0.001);
    CHECK_THAT(result["words"].dump(),
               Catch::Contains("Its 40 answers share: ") && Catch::Contains("May be chosen freely: "));
    const json& target = result["targets"]["drawn"];
    CHECK(target["answers"] == 40);
    std::vector<std::string> controlled;
    for (const json& one : target["control"])
        controlled.push_back(one[0]);
    std::sort(controlled.begin(), controlled.end());
    CHECK(std::adjacent_find(controlled.begin(), controlled.end()) == controlled.end());
    // The command on the page: the best answer is brought back by them.
    const std::string control =
        target["control"][0][0].get<std::string>() + "," + target["control"][1][0].get<std::string>();
    CHECK(app::testing::rugosa(
              "design --from r/best/drawn.json --nodes 64 --steps 8 --control " + control +
                  " --largest-change 0.05 --max-pressure 1.6e-4 --pictures off --target '" RUGOSA_SOURCE
                  "/experiments/targets/drawn.csv' --reach-similarity 0.9 --out m",
              folder.path())
              .code != 2);
    app::testing::expect_repeated(words, folder, {"surfaces.csv", "features.csv", "heldout.csv"});
}
