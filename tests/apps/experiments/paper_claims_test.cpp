#include "apps/experiments/paper/chromosome_example.hpp"
#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/experiments/paper/readings.hpp"
#include "apps/experiments/paper/variant_runs.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app;

namespace {

StageRecord stage(const std::string& path, const std::vector<std::pair<std::uint64_t, double>>& candidates) {
    StageRecord record{path, {}};
    for (const auto& [id, similarity] : candidates)
        record.candidates.push_back({id, {}, similarity});
    return record;
}

ThresholdRow row(double p_bar, const std::string& variant, double similarity,
                 std::vector<std::uint64_t> parents) {
    ThresholdRow threshold;
    threshold.p_bar = p_bar;
    threshold.variant = variant;
    threshold.u1 = 3;
    threshold.u2 = variant == "gco" && p_bar > 0.5 ? 4 : 3;
    threshold.share_above = variant == "gco" ? 0.5 : 0.25;
    threshold.parents = std::move(parents);
    threshold.similarity = similarity;
    return threshold;
}

Verdict verdict(const std::vector<Claim>& claims, const std::string& begin) {
    for (const Claim& claim : claims)
        if (claim.says.starts_with(begin))
            return claim.verdict;
    FAIL("no claim begins with " << begin);
    return {};
}

PaperRun run_with(const std::vector<TargetRun>& targets) {
    PaperRun run;
    run.targets = targets;
    return run;
}

} // namespace

TEST_CASE("a claim is reproduced on every target, contradicted on none, and undecidable in between") {
    CHECK(verdict_over({true, true}) == Verdict::reproduced);
    CHECK(verdict_over({false, false}) == Verdict::contradicted);
    CHECK(verdict_over({true, false}) == Verdict::undecidable);
    CHECK(verdict_over({true, std::nullopt}) == Verdict::undecidable);
    CHECK(verdict_over({}) == Verdict::undecidable);
}

TEST_CASE("candidates are followed by their identity through both refinements") {
    VariantRun variant;
    variant.stages = {stage("sog/score.1", {{0, 0.1}, {1, 0.2}, {2, 0.3}}),
                      stage("sog/best.1", {{2, 0.3}, {1, 0.2}}), stage("sog/refine.1", {{1, 0.5}, {2, 0.4}}),
                      stage("sog/refine.2", {{2, 0.6}, {1, 0.5}}), stage("sog/best.2", {{2, 0.6}})};
    const auto followed = refinements(variant);
    REQUIRE(followed.size() == 2);
    CHECK(followed[0].id == 2);
    CHECK(followed[0].similarity == std::array<double, 3>{0.3, 0.4, 0.6});
    CHECK(followed[1].similarity == std::array<double, 3>{0.2, 0.5, 0.5});

    variant.stages.erase(variant.stages.begin() + 3); // CCO: one refinement, copied
    CHECK(refinements(variant)[0].similarity == std::array<double, 3>{0.3, 0.4, 0.4});
    CHECK(refinements({}).empty());
}

TEST_CASE("a curve that is good in one part is not good over all pressures") {
    TargetRun target;
    target.database = {{0.96, 0.99, 0.97}, {0.89, 0.97, 0.9}, {0.88, 0.89, 0.99}, {0.5, 0.6, 0.7}};
    CHECK(best_in_part(target, true)->genome == 1);
    CHECK(best_in_part(target, false)->genome == 2);
    target.database.resize(1);
    CHECK(best_in_part(target, true)->genome == 0);
    CHECK(!best_in_part({}, true));
}

TEST_CASE("verdicts on the threshold's part turn when the numbers do") {
    TargetRun as_paper;
    as_paper.thresholds = {row(0.4, "gco", 0.93, {1, 2}), row(0.4, "cco", 0.95, {3, 4}),
                           row(0.6, "gco", 0.97, {5, 6}), row(0.6, "cco", 0.952, {4, 3})};
    auto claims = search_claims(run_with({as_paper, as_paper}));
    CHECK(verdict(claims, "GCO's best similarity varies") == Verdict::reproduced);
    CHECK(verdict(claims, "CCO's does not") == Verdict::reproduced);
    CHECK(verdict(claims, "CCO's best keeps") == Verdict::reproduced);
    CHECK(verdict(claims, "GCO is the more efficient") == Verdict::reproduced);
    CHECK(verdict(claims, "|U<sub>3</sub>| varies") == Verdict::reproduced);
    CHECK(verdict(claims, "|U<sub>3</sub>| is equal") == Verdict::contradicted);

    TargetRun otherwise = as_paper;
    otherwise.thresholds[2].similarity = 0.931;
    otherwise.thresholds[3] = row(0.6, "cco", 0.90, {7, 8});
    for (ThresholdRow& threshold : otherwise.thresholds)
        threshold.share_above = 1 - threshold.share_above;
    claims = search_claims(run_with({otherwise, otherwise}));
    CHECK(verdict(claims, "GCO's best similarity varies") == Verdict::contradicted);
    CHECK(verdict(claims, "CCO's does not") == Verdict::contradicted);
    CHECK(verdict(claims, "CCO's best keeps") == Verdict::contradicted);
    CHECK(verdict(claims, "GCO is the more efficient") == Verdict::contradicted);

    claims = search_claims(run_with({as_paper, otherwise}));
    CHECK(verdict(claims, "CCO's best keeps") == Verdict::undecidable);
}

TEST_CASE("a run without a sweep leaves its claims undecidable") {
    for (const Claim& claim : search_claims(run_with({{}, {}}))) {
        CHECK(claim.verdict == Verdict::undecidable);
        CHECK(claim.measured.find("not in this run") != std::string::npos);
    }
}

TEST_CASE("condition (10) holds always, Eq. 8 for half of all phases, and a lost pair costs what an integral "
          "says") {
    // For M = 2 the lost pair leaves |cos a + cos b| <= sqrt(2); the share by the midpoint rule.
    constexpr int cells = 1000;
    int held = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j)
            held += std::abs(std::cos(2 * M_PI * (i + 0.5) / cells) +
                             std::cos(2 * M_PI * (j + 0.5) / cells)) <= std::sqrt(2.0);
    const double share = held / double(cells * cells);
    constexpr int sets = 20000;
    for (const RidgeCount& count : ridge_study({2, 3, 17, 200}, sets, 4)) {
        CHECK(count.as_printed == 1);
        CHECK(count.right_phase == Approx(0.5).margin(4 * 0.5 / std::sqrt(sets)));
        if (count.ridges == 2)
            CHECK(count.last_missing == Approx(share).margin(4 * 0.5 / std::sqrt(sets)));
        else
            CHECK(count.last_missing < 1);
    }
}

TEST_CASE("a threshold's row counts its children, and those above 0.95") {
    VariantRun run;
    run.name = "gco";
    run.similarity = 0.99;
    run.stages = {stage("gco/pair.1/left/above.1", {{0, 0.96}, {1, 0.97}}),
                  stage("gco/pair.1/right/above.1", {{0, 0.96}, {1, 0.97}, {2, 0.98}}),
                  stage("gco/score.1", {{3, 0.95}, {4, 0.951}, {5, 0.4}, {6, 0.2}}),
                  stage("gco/best.1", {{4, 0.99}})};
    run.stages.back().candidates.front().parents = {0, 2};
    const ThresholdRow found = threshold_row(run, 3);
    CHECK(found.p_bar == 3);
    CHECK(found.u1 == 2);
    CHECK(found.u2 == 3);
    CHECK(found.children == 4);
    CHECK(found.share_above == 0.25);
    CHECK(found.best_child == 0.951);
    CHECK(found.parents == std::vector<std::uint64_t>{0, 2});
    CHECK(found.similarity == 0.99);
}

TEST_CASE("half of the waves gone changes both curves, and another datum the similarity") {
    PaperRun run;
    run.model.grid.nodes = 64;
    run.model.loading.steps = 8;
    run.model = completed(run.model);
    run.max_pressure = 1e-4;
    run.database = answered({rough::Genome{1, {{1, 0.8, 2, run.model.grid.length, {{1, {0.3}}, {2, {1}}}}}}},
                            run.model, run.max_pressure, 1);
    const Readings readings = readings_of(run);
    REQUIRE(readings.without_coarse.size() == 1);
    REQUIRE(readings.without_fine.size() == 1);
    for (const Removal& removal : {readings.without_coarse[0], readings.without_fine[0]}) {
        CHECK(removal.stiffness > 0);
        CHECK(removal.area > 0);
    }
    CHECK(readings.without_coarse[0].stiffness > readings.without_fine[0].stiffness);
    CHECK(readings.datum_similarity[0] < 1);
}

TEST_CASE("eight ridges are one cosine of their wave length") {
    for (int n : {1, 2}) {
        const ChromosomeExample example = chromosome_example(n, 3);
        CHECK(example.wave_length == Approx(n == 1 ? 0.1 : 0.1 / 1.5));
        CHECK(example.misfit < 1e-13);
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(example.x.size());
        for (const Eigen::VectorXd& ridge : example.ridges)
            sum += ridge;
        CHECK((sum - example.sum).cwiseAbs().maxCoeff() < 1e-15);
        const auto falls = [](const Eigen::VectorXd& ridge) {
            return ridge[1] < 0;
        }; // a phase over half a turn
        CHECK(std::any_of(example.ridges.begin(), example.ridges.end(), falls));
        CHECK_FALSE(std::all_of(example.ridges.begin(), example.ridges.end(), falls));
    }
}

TEST_CASE("curves are compared where both can be read") {
    const rough::Curve line{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3), 0, 3};
    const rough::Curve half{Eigen::Vector2d(0, 2), Eigen::Vector2d(0, 3), 0, 2};
    CHECK(relative_gap(line, half) == Approx(0.5));
    CHECK(relative_gap(line, line) == 0);
    CHECK(gap(line, half) == Approx(1));
    CHECK(std::isnan(gap(line, {Eigen::Vector2d(4, 5), Eigen::Vector2d(1, 1), 4, 5})));
}
