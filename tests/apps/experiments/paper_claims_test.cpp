#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/variant_runs.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app;

namespace {

constexpr double L = 2;

const Claim& claim_of(const std::string& id) {
    for (const Claim& claim : paper_claims())
        if (claim.id == id)
            return claim;
    throw std::runtime_error("no claim " + id);
}

StageRecord stage(const std::string& path, const std::vector<std::pair<std::uint64_t, double>>& candidates) {
    StageRecord record{path, {}};
    for (const auto& [id, similarity] : candidates)
        record.candidates.push_back({id, {}, similarity});
    return record;
}

/// K(p) is 1, 2, 3 at p = 0.5, 2, 4.5 MPa; a contact fraction that grows with the pressure.
rough::Response response_of_area(double last) {
    rough::Response response;
    response.displacement = Eigen::Vector3d(1, 2, 3);
    response.pressure = Eigen::Vector3d(1, 3, 6);
    response.contact_fraction = last / 6 * response.pressure;
    return response;
}

/// Waves of 1, 2, 4, ... over the length with these phases.
rough::Genome waves_of(const std::vector<double>& phases, double H = 0.8) {
    rough::Genome genome{1, {{1, H, 2, L, {}}}};
    for (std::size_t n = 0; n < phases.size(); ++n)
        genome.series[0].chromosomes.push_back({static_cast<int>(n) + 1, {phases[n]}});
    return genome;
}

VariantRun variant(const std::string& name, const rough::Genome& genome, double area = 0.1,
                   double similarity = 0.96) {
    VariantRun run;
    run.name = name;
    run.answer = {genome, response_of_area(area)};
    run.similarity = similarity;
    run.seconds = 60;
    return run;
}

ThresholdRow row(double p_bar, const std::string& name, double similarity,
                 std::vector<std::uint64_t> parents) {
    ThresholdRow threshold;
    threshold.p_bar = p_bar;
    threshold.variant = name;
    threshold.u1 = 3;
    threshold.u2 = name == "gco" && p_bar > 0.5 ? 4 : 3;
    threshold.parents = std::move(parents);
    threshold.similarity = threshold.best_child = similarity;
    return threshold;
}

PaperRun run_with(const std::vector<TargetRun>& targets) {
    PaperRun run;
    run.model.grid = {64, L, true};
    run.max_pressure = 6;
    run.targets = targets;
    return run;
}

Verdict verdict(const std::string& id, const std::vector<TargetRun>& targets) {
    return evaluated(claim_of(id), run_with(targets), {}).verdict;
}
Verdict verdict(const std::string& id, const TargetRun& target) {
    return verdict(id, std::vector<TargetRun>{target, target});
}
Verdict verdict(const std::string& id, const Studies& studies) {
    return evaluated(claim_of(id), run_with({}), studies).verdict;
}

TargetRun answers(VariantRun sog, VariantRun gco, VariantRun cco) {
    TargetRun target;
    target.variants = {std::move(sog), std::move(gco), std::move(cco)};
    return target;
}

constexpr auto yes = Verdict::reproduced, no = Verdict::contradicted, open = Verdict::undecidable;

} // namespace

TEST_CASE("a condition decides on its bound as it is written") {
    const Claim within{"", "", "", "", claim_of("large").find, ">= 30 and <= 120", "> 120"};
    CHECK(verdict_of(within, {30}) == yes);
    CHECK(verdict_of(within, {120, 30}) == yes);
    CHECK(verdict_of(within, {29.9}) == open);
    CHECK(verdict_of(within, {120.1}) == no);
    const Claim below{"", "", "", "", within.find, "< 2"};
    CHECK(verdict_of(below, {1.9}) == yes);
    CHECK(verdict_of(below, {2}) == no);
    const Claim equal{"", "", "", "", within.find, "= 1"};
    CHECK(verdict_of(equal, {1}) == yes);
    CHECK(verdict_of(equal, {2}) == no);
    const Claim above{"", "", "", "", within.find, "> 0", "never"};
    CHECK(verdict_of(above, {0}) == open);
}

TEST_CASE("targets that differ, or an unknown number, leave a claim undecidable") {
    for (const Claim& claim : paper_claims()) {
        CHECK(verdict_of(claim, {}) == open);
        CHECK(verdict_of(claim, {NAN}) == open);
        for (const double number : {-1., 0., 0.5, 1., 2., 50., 1e9})
            for (const Verdict one : {verdict_of(claim, {number})}) {
                CHECK(verdict_of(claim, {number, NAN}) == open);
                CHECK(verdict_of(claim, {number, number}) == one);
            }
    }
    const Claim& large = claim_of("large");
    CHECK(verdict_of(large, {0.95, 0.85}) == open);
}

TEST_CASE("a run without searches and studies has no verdict on any claim") {
    for (const auto& targets : {std::vector<TargetRun>{}, std::vector<TargetRun>(2)})
        for (const Claim& claim : paper_claims()) {
            INFO(claim.id);
            CHECK(evaluated(claim, run_with(targets), {}).verdict ==
                  (claim.id == "even-pairs" ? yes : open)); // Sobol's pairs are always there
        }
}

TEST_CASE("every claim but those without data can be reproduced, and the rest contradicted") {
    for (const Claim& claim : paper_claims()) {
        std::set<Verdict> reached;
        for (double number : {-1e3, -0.5, 0., 1e-13, 0.04, 0.3, 0.97, 1., 1.5, 50., 66.6, 1e3})
            reached.insert(verdict_of(claim, {number}));
        CHECK(reached.contains(yes) == (claim.reproduced != "never"));
        CHECK(reached.contains(no) == (claim.contradicted != "never"));
    }
}

TEST_CASE("candidates are followed by their identity through both refinements") {
    VariantRun run;
    run.stages = {stage("sog/score.1", {{0, 0.1}, {1, 0.2}, {2, 0.3}}),
                  stage("sog/best.1", {{2, 0.3}, {1, 0.2}}), stage("sog/refine.1", {{1, 0.5}, {2, 0.4}}),
                  stage("sog/refine.2", {{2, 0.6}, {1, 0.5}}), stage("sog/best.2", {{2, 0.6}})};
    const auto followed = refinements(run);
    REQUIRE(followed.size() == 2);
    CHECK(followed[0].id == 2);
    CHECK(followed[0].similarity == std::array<double, 3>{0.3, 0.4, 0.6});
    CHECK(followed[1].similarity == std::array<double, 3>{0.2, 0.5, 0.5});
    run.stages.erase(run.stages.begin() + 3); // CCO: one refinement, copied
    CHECK(refinements(run)[0].similarity == std::array<double, 3>{0.3, 0.4, 0.4});
    CHECK(refinements({}).empty());
}

TEST_CASE("GCMMA is beneficial if the best candidate of each algorithm gains, whatever the others do") {
    const auto with_gain = [](double gain) {
        TargetRun target = answers(variant("sog", {}), variant("gco", {}), variant("cco", {}));
        for (VariantRun& run : target.variants) // the second candidate loses
            run.stages = {
                stage(run.name + "/best.1", {{0, 0.9}, {1, 0.8}}),
                stage(run.name + "/refine.1", {{0, 0.9 + (run.name == "gco" ? gain : 0.05)}, {1, 0.7}})};
        return target;
    };
    CHECK(verdict("beneficial", with_gain(0.01)) == yes);
    CHECK(verdict("beneficial", with_gain(-0.01)) == no);
}

TEST_CASE("similarity, time and number of chromosomes are judged over the three algorithms") {
    const auto three = [](double similarity, double seconds) {
        TargetRun target = answers(variant("sog", waves_of({0, 0})), variant("gco", waves_of({0, 0})),
                                   variant("cco", waves_of({0}), 0.1, similarity));
        target.variants[0].seconds = seconds;
        return target;
    };
    CHECK(verdict("large", three(0.9, 60)) == yes);
    CHECK(verdict("large", three(0.89, 60)) == no);
    CHECK(verdict("overlap", three(0.951, 60)) == yes);
    CHECK(verdict("overlap", three(0.949, 60)) == no);
    CHECK(verdict("minute", three(1, 60)) == yes);
    CHECK(verdict("minute", three(1, 121)) == no);
    TargetRun fast = three(1, 0.1);
    fast.variants[1].seconds = fast.variants[2].seconds = 0.2;
    CHECK(verdict("minute", fast) == open);
    CHECK(verdict("fewer-chromosomes", three(1, 60)) == yes);
    std::swap(fast.variants[0].name, fast.variants[2].name);
    fast.variants[1].answer = fast.variants[0].answer;
    CHECK(verdict("fewer-chromosomes", fast) == no);
    fast.variants.pop_back();
    CHECK(verdict("large", fast) == open);
}

TEST_CASE("verdicts on the threshold turn when the numbers do") {
    TargetRun as_paper;
    as_paper.thresholds = {row(0.4, "gco", 0.93, {1, 2}), row(0.4, "cco", 0.92, {3, 4}),
                           row(0.6, "gco", 0.97, {5, 6}), row(0.6, "cco", 0.925, {4, 3})};
    for (const char* id : {"gco-varies", "cco-steady", "cco-parents", "efficient", "size-varies"})
        CHECK(verdict(id, as_paper) == yes);
    CHECK(verdict("size-equal", as_paper) == no);
    TargetRun otherwise = as_paper;
    otherwise.thresholds = {row(0.4, "gco", 0.93, {1, 2}), row(0.4, "cco", 0.95, {3, 4}),
                            row(0.45, "gco", 0.931, {5, 6}), row(0.45, "cco", 0.98, {7, 8})};
    for (const char* id : {"gco-varies", "cco-steady", "cco-parents", "efficient", "size-varies"})
        CHECK(verdict(id, otherwise) == no);
    CHECK(verdict("size-equal", otherwise) == yes);
    CHECK(verdict("cco-parents", std::vector<TargetRun>{as_paper, otherwise}) == open);
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
    CHECK(found.u1 * found.u2 == 6);
    CHECK(found.children == 4);
    CHECK(found.share_above == 0.25);
    CHECK(found.best_child == 0.951);
    CHECK(found.parents == std::vector<std::uint64_t>{0, 2});
}

TEST_CASE("areas are alike for two answers only if both are far from the third") {
    const auto alike = [](double sog, double gco, double cco) {
        const auto genome = waves_of({0});
        return verdict("area-alike", answers(variant("sog", genome, sog), variant("gco", genome, gco),
                                             variant("cco", genome, cco)));
    };
    CHECK(alike(0.10, 0.11, 0.14) == yes);
    CHECK(alike(0.10, 0.12, 0.07) == no); // 0.02 is not less than half of 0.03
    CHECK(alike(0.10, 0.10, 0.10) == no);
}

TEST_CASE("profiles are alike by the correlation of their heights") {
    // For waves that are shifted by an angle it is the angle's cosine.
    const auto similar = [](const char* id, double gco, double cco) {
        return verdict(id, answers(variant("sog", waves_of({0})), variant("gco", waves_of({gco})),
                                   variant("cco", waves_of({cco}))));
    };
    CHECK(similar("peaks-alike", std::acos(0.52), 0) == yes);
    CHECK(similar("peaks-alike", 0, std::acos(0.48)) == no);
    CHECK(similar("cco-approximates", 1, 1 + std::acos(0.92)) == yes);
    CHECK(similar("cco-approximates", 1, 1 + std::acos(0.88)) == no);
}

TEST_CASE("a spectrum matches its own waves unless the profile holds more than they show") {
    const std::vector<double> phases{0.1, 1.2, 2.3, 0.4, 1.5};
    const auto with = [&](const rough::Genome& genome) {
        return answers(variant("sog", genome), variant("gco", genome),
                       variant("cco", waves_of(phases, -0.5)));
    };
    const TargetRun periodic = with(waves_of(phases));
    CHECK(verdict("match-high", periodic) == yes);
    CHECK(verdict("differ-low", periodic) == no);
    CHECK(verdict("extra-peaks", periodic) == no);
    CHECK(verdict("cco-flat", periodic) == yes); // density k^-(2H + 1)
    CHECK(verdict("cco-flat",
                  answers(variant("sog", {}), variant("gco", {}), variant("cco", waves_of(phases)))) == no);
    // Longer waves than the profile are in its spectrum, but not in the octaves of its genome.
    rough::Genome aliased = waves_of(phases);
    aliased.series.push_back({10, 0.8, 2, L / 40, {{1, {0.7}}}}); // beyond the Nyquist wavenumber, seen at 24
    CHECK(verdict("extra-peaks", with(aliased)) == yes);
    CHECK(verdict("match-high", with(aliased)) == no);
}

TEST_CASE("CCO's spectrum is proportional to SOG's if only its scale differs") {
    const auto shaped = [](double H) {
        const std::vector<double> phases{0.1, 1.2, 2.3, 0.4, 1.5};
        rough::Genome scaled = waves_of(phases, H);
        scaled.scale = 7;
        return answers(variant("sog", waves_of(phases, 0.8)), variant("gco", {}), variant("cco", scaled));
    };
    CHECK(verdict("cco-proportional", shaped(0.8)) == yes);
    CHECK(verdict("cco-proportional", shaped(4)) == no);
}

TEST_CASE("verdicts on formulas and parts of a genome turn when their numbers do") {
    Studies studies;
    studies.chromosomes = {{1, 0.1, {}, {}, {}, 1e-15}, {2, 0.0666, {}, {}, {}, 1e-14}};
    studies.ridges = {{2, 0.9, 0.9, 0.995}, {8, 0.97, 0.9, 0.995}};
    studies.same_pressure = {{0.3, 0.95}, {0.4, 0.92}, {0.5, 0.91}};
    studies.without_coarse = {{2, 0.1}};
    studies.without_fine = {{0.1, 2}};
    studies.contacts = {100, 1};
    FractalStudy alloy;
    alloy.whole_response = alloy.reduced_response = response_of_area(0.1);
    studies.fractals = {alloy};
    const std::vector<std::string> ids{"nesting",         "one-wave",      "wavelength",       "condition",
                                       "arccos",          "part-suffices", "coarse-stiffness", "fine-area",
                                       "alloy-stiffness", "alloy-area"};
    for (const std::string& id : ids)
        CHECK(verdict(id, studies) == yes);
    studies.chromosomes = {{1, 0.1, {}, {}, {}, 2e-12}, {2, 0.0668, {}, {}, {}, 0}};
    studies.ridges[1] = {8, 1, 0.9, 0.5};
    studies.same_pressure = {{0.3, 0.4}};
    std::swap(studies.without_coarse, studies.without_fine);
    studies.contacts.lost = 0;
    studies.fractals[0].reduced_response.contact_fraction *= 1.12;
    studies.fractals[0].reduced_response.displacement *= 1.12; // K falls by as much
    for (const std::string& id : ids) // another profile than the alloy's cannot contradict
        CHECK(verdict(id, studies) == (id.starts_with("alloy") ? open : no));
    studies.same_pressure = {{0.3, 0.7}};
    CHECK(verdict("part-suffices", studies) == open);
    studies.same_pressure = {{1, 0.95}}; // all chromosomes are kept
    CHECK(verdict("part-suffices", studies) == open);
}

TEST_CASE("a part of the target is met better than the whole by a genome that is poor over all pressures") {
    TargetRun target;
    target.database = {{0.96, 0.99, 0.97}, {0.95, 0.96, 0.9}, {0.88, 0.89, 0.94}};
    CHECK(best_in_part(target, true) == 1);
    CHECK(best_in_part(target, false) == 2);
    CHECK(verdict("low-part", target) == yes);
    CHECK(verdict("high-part", target) == no);
    target.database.resize(1);
    CHECK(verdict("low-part", target) == open);
}

TEST_CASE("p_max is compared with the largest pressure of the database, and a target with its curves") {
    for (const double scale : {1.1, -1.1, 0.9, -0.9}) {
        PaperRun run = run_with({});
        run.database = {{waves_of({0}), response_of_area(0.1)}, {waves_of({0}), response_of_area(0.1)}};
        run.database[0].genome.scale = 2, run.database[1].genome.scale = scale;
        CHECK(evaluated(claim_of("max-pressure"), run, {}).verdict == (std::abs(scale) > 1 ? yes : no));
        run.database[1].response.displacement /= 2; // K is 1, 2 and 3, and twice that
        TargetRun target;
        target.target.x = Eigen::Vector3d(0.5, 2, 4.5);
        target.target.y = Eigen::Vector3d(1.5, 4.1, 6.1);
        run.targets = {target};
        CHECK(evaluated(claim_of("trend"), run, {}).findings[0].second.number == Approx(1. / 3));
    }
}

TEST_CASE("the Sobol pairs' discrepancy is the integral that defines it") {
    const PaperRun run = run_with({});
    const auto pairs = sobol_pairs(run.layout);
    const auto n = static_cast<double>(pairs.size());
    constexpr int cells = 400;
    double integral = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double x = (i + 0.5) / cells, y = (j + 0.5) / cells;
            int inside = 0;
            for (const auto& [H, gamma] : pairs)
                inside += H < run.layout.H_from + x * (run.layout.H_to - run.layout.H_from) &&
                          gamma < run.layout.gamma_from + y * (run.layout.gamma_to - run.layout.gamma_from);
            integral += std::pow(inside / n - x * y, 2) / (cells * cells);
        }
    const Finding found = evaluated(claim_of("even-pairs"), run, {}).findings[0].second;
    CHECK(found.parts[0].second == Approx(std::sqrt(integral)).epsilon(0.02));
}
