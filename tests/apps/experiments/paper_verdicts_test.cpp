#include "apps/experiments/paper/claims.hpp"
#include "apps/report/units.hpp"
#include "domain/response/curve.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace app;

namespace {

constexpr double L = 2;

Verdict verdict(const std::vector<Claim>& claims, const std::string& begin) {
    for (const Claim& claim : claims)
        if (claim.says.starts_with(begin))
            return claim.verdict;
    FAIL("no claim begins with " << begin);
    return {};
}

/// Waves of L, L/2, L/4, ... by a law k^-H, of these phases.
rough::Genome waves_of(std::vector<double> phases, double H = 0.8, double scale = 1) {
    rough::Genome genome{scale, {{1, H, 2, L, {}}}};
    for (const double phase : phases)
        genome.series[0].chromosomes.push_back(
            {static_cast<int>(genome.series[0].chromosomes.size()) + 1, {phase}});
    return genome;
}

/// A response of which three points are known; its contact area is `area` times its pressure.
rough::Response of_area(double area) {
    rough::Response response;
    response.displacement = Eigen::Vector3d(1, 2, 3);
    response.pressure = Eigen::Vector3d(1, 3, 6);
    response.contact_fraction = area * response.pressure;
    return response;
}

VariantRun variant(const std::string& name, const rough::Genome& genome, double area = 0.1,
                   double similarity = 0.99) {
    VariantRun run;
    run.name = name;
    run.answer = {genome, of_area(area)};
    run.similarity = similarity;
    return run;
}

std::vector<Claim> claims_on(const VariantRun& sog, const VariantRun& gco, const VariantRun& cco) {
    PaperRun run;
    run.model.grid = {64, L, true};
    TargetRun target;
    target.variants = {sog, gco, cco};
    run.targets = {target, target};
    return answer_claims(run);
}

StageRecord stage(const std::string& path, double similarity) {
    return {path, {{0, {}, similarity}, {1, {}, similarity + 0.01}}};
}

/// Studies that say what the paper says, as far as they bear on its claims.
Studies as_paper() {
    Studies studies;
    studies.chromosomes.resize(2);
    studies.chromosomes[0].misfit = studies.chromosomes[1].misfit = 1e-14;
    studies.chromosomes[1].wave_length = 0.0666;
    studies.ridges = {{2, 0.9, 0.9, 0.995}, {3, 0.97, 0.97, 0.999}};
    studies.fractals.resize(3);
    for (FractalStudy& study : studies.fractals)
        study.whole_response = study.reduced_response = of_area(0.1);
    studies.readings.same_pressure = {{0.4, 0.95}, {0.5, 0.92}, {0.6, 0.2}};
    studies.readings.without_coarse = {{0.5, 0.1}, {0.6, 0.1}, {0.1, 0.1}};
    studies.readings.without_fine = {{0.2, 0.4}, {0.3, 0.4}, {0.4, 0.05}};
    return studies;
}

PaperRun run_of(double max_pressure) {
    PaperRun run;
    run.max_pressure = max_pressure;
    for (const double scale : {0.5, -0.25}) // their own last pressures are 2 and 4 MPa
        run.database.push_back({waves_of({0}, 0.8, scale * max_pressure), of_area(0.1)});
    return run;
}

} // namespace

TEST_CASE("answers overlap the target where all three do, and need their chromosomes counted") {
    const auto one = waves_of({0}), two = waves_of({0, 1}), three = waves_of({0, 1, 2});
    const auto claims = claims_on(variant("sog", two, 0.1, 0.95), variant("gco", three), variant("cco", two));
    CHECK(verdict(claims, "The answers' K(p) overlap") == Verdict::reproduced);
    CHECK(verdict(claims, "CCO (printed: GCO)") == Verdict::reproduced);
    for (int missed = 0; missed < 3; ++missed)
        CHECK(verdict(claims_on(variant("sog", one, 0.1, missed == 0 ? 0.949 : 0.99),
                                variant("gco", two, 0.1, missed == 1 ? 0.949 : 0.99),
                                variant("cco", two, 0.1, missed == 2 ? 0.949 : 0.99)),
                      "The answers' K(p) overlap") == Verdict::contradicted);
    CHECK(verdict(claims_on(variant("sog", three), variant("gco", two), variant("cco", two)),
                  "CCO (printed: GCO)") == Verdict::contradicted);
}

TEST_CASE("areas are alike for two answers only where both are far from the third") {
    const auto alike = [](double sog, double gco, double cco) {
        const auto genome = waves_of({0});
        return verdict(
            claims_on(variant("sog", genome, sog), variant("gco", genome, gco), variant("cco", genome, cco)),
            "A(p) is alike");
    };
    CHECK(alike(0.10, 0.11, 0.14) == Verdict::reproduced);
    CHECK(alike(0.10, 0.11, 0.07) == Verdict::reproduced);
    CHECK(alike(0.10, 0.12, 0.07) == Verdict::contradicted); // 0.02 is not less than half of 0.03
    CHECK(alike(0.10, 0.12, 0.15) == Verdict::contradicted);
    CHECK(alike(0.10, 0.10, 0.10) == Verdict::contradicted);
}

TEST_CASE("profiles are alike by the correlation of their heights") {
    // Of waves a turn apart by an angle it is the angle's cosine.
    const auto similar = [](double gco, double cco, const std::string& claim) {
        return verdict(claims_on(variant("sog", waves_of({0})), variant("gco", waves_of({gco})),
                                 variant("cco", waves_of({cco}))),
                       claim);
    };
    const std::string peaks = "Peaks and valleys", near = "CCO's profile approximates";
    CHECK(similar(std::acos(0.52), 0, peaks) == Verdict::reproduced);
    CHECK(similar(std::acos(0.48), 0, peaks) == Verdict::contradicted);
    CHECK(similar(0, std::acos(0.48), peaks) == Verdict::contradicted);
    CHECK(similar(1, 1 + std::acos(0.92), near) == Verdict::reproduced);
    CHECK(similar(1, 1 + std::acos(0.88), near) == Verdict::contradicted);
}

TEST_CASE(
    "spectra match where their powers differ by less than a factor of two, and are flat by their slope") {
    const std::vector<double> phases{0.1, 1.2, 2.3, 0.4, 1.5};
    const std::string high = "SOG's and GCO's spectra match", low = "They do not match",
                      flat = "CCO's spectrum is flat";
    const auto of = [&](double scale, double H) { return waves_of(phases, H, scale); };
    const auto compared = [&](double power, const std::string& claim) {
        return verdict(claims_on(variant("sog", of(1, 0.8)), variant("gco", of(std::sqrt(power), 0.8)),
                                 variant("cco", of(1, 0.8))),
                       claim);
    };
    CHECK(compared(1.9, high) == Verdict::reproduced);
    CHECK(compared(1 / 1.9, high) == Verdict::reproduced);
    CHECK(compared(2.1, high) == Verdict::contradicted);
    CHECK(compared(1.9, low) == Verdict::contradicted);
    CHECK(compared(2.1, low) == Verdict::reproduced);
    CHECK(compared(1 / 2.1, low) == Verdict::reproduced);
    for (const int n : {1, 5}) { // a wave among the longest, or among the shortest
        rough::Genome another = of(1, 0.8);
        another.series.push_back({30, 0.8, 2, L, {{n, {0.7}}}});
        const auto claims =
            claims_on(variant("sog", of(1, 0.8)), variant("gco", another), variant("cco", of(1, 0.8)));
        CHECK(verdict(claims, high) == (n == 1 ? Verdict::reproduced : Verdict::contradicted));
        CHECK(verdict(claims, low) == (n == 1 ? Verdict::reproduced : Verdict::contradicted));
    }
    // Density k^-(2H + 1), in octaves.
    const auto flatness = [&](double H) {
        return verdict(
            claims_on(variant("sog", of(1, 0.8)), variant("gco", of(1, 0.8)), variant("cco", of(1, H))),
            flat);
    };
    CHECK(flatness(-0.5) == Verdict::reproduced);
    CHECK(flatness(0.8) == Verdict::contradicted);
    CHECK(flatness(-4) == Verdict::contradicted);
}

TEST_CASE("answers that a run has not are claimed nowhere") {
    for (const Claim& claim : answer_claims({})) {
        CHECK(claim.verdict == Verdict::undecidable);
        CHECK(claim.measured == "Not in this run.");
    }
    PaperRun run;
    run.model.grid = {64, L, true};
    run.targets.resize(1);
    run.targets[0].variants = {variant("sog", waves_of({0})), variant("cco", waves_of({0}))};
    CHECK(answer_claims(run)[0].measured == "Not in this run.");
}

TEST_CASE("verdicts on the searches turn when one answer, candidate or time does") {
    const auto claims = [](double similarity, double gain, double seconds) {
        TargetRun target;
        for (const char* name : {"sog", "gco", "cco"}) {
            VariantRun run;
            run.name = name;
            run.similarity = run.name == "gco" ? similarity : 0.95;
            run.seconds = run.name == "cco" ? seconds : 1;
            run.stages = {stage(run.name + "/best.1", 0.5),
                          stage(run.name + "/refine.1", run.name == "sog" ? 0.5 + gain : 0.6)};
            target.variants.push_back(run);
        }
        PaperRun run;
        run.targets = {target, target};
        return search_claims(run);
    };
    const std::string large = "The three algorithms reach", gain = "GCMMA is beneficial",
                      minute = "Each algorithm takes";
    for (const std::string& claim : {large, gain, minute})
        CHECK(verdict(claims(0.9, 0.001, 60), claim) == Verdict::reproduced);
    CHECK(verdict(claims(0.899, 0.001, 60), large) == Verdict::contradicted);
    CHECK(verdict(claims(0.9, 0, 60), gain) == Verdict::contradicted);
    CHECK(verdict(claims(0.9, 0.001, 60.1), minute) == Verdict::contradicted);
}

TEST_CASE("verdicts on series and studies turn when their numbers do") {
    const auto now = [](const Studies& studies, double max_pressure = 5) {
        return series_claims(run_of(max_pressure), studies);
    };
    const std::string wave = "The sum of a chromosome's", condition = "Condition (10)",
                      phase = "The phase of the sum", needs = "K(p) needs only part", coarse = "Coarse waves",
                      fine = "Fine waves", alloy = "K(p) of the alloy's", area = "So do their A(p)",
                      pressures = "p<sub>max</sub> is larger";
    const auto paper = now(as_paper());
    for (const std::string& claim : {wave, condition, phase, needs, coarse, fine, alloy, area, pressures})
        CHECK(verdict(paper, claim) == Verdict::reproduced);

    Studies other = as_paper();
    other.chromosomes[0].misfit = 2e-12;
    CHECK(verdict(now(other), wave) == Verdict::contradicted);
    other = as_paper();
    other.chromosomes[1].wave_length = 0.0668;
    CHECK(verdict(now(other), wave) == Verdict::contradicted);
    for (const double share : {0.88, 0.985}) {
        other = as_paper();
        other.ridges[1].as_printed = share;
        CHECK(verdict(now(other), condition) == Verdict::contradicted);
    }
    other = as_paper();
    other.ridges[0].right_phase = 0.5;
    CHECK(verdict(now(other), phase) == Verdict::contradicted);
    other = as_paper();
    other.readings.same_pressure[1].similarity = 0.89;
    other.readings.same_pressure[0].similarity = 0.89; // the median
    CHECK(verdict(now(other), needs) == Verdict::undecidable);
    other.readings.same_pressure[0].similarity = other.readings.same_pressure[1].similarity = 0.49;
    CHECK(verdict(now(other), needs) == Verdict::contradicted);
    other = as_paper();
    for (Reduction& row : other.readings.same_pressure)
        row.kept = 1;
    CHECK(verdict(now(other), needs) == Verdict::undecidable);
    other = as_paper();
    std::swap(other.readings.without_coarse, other.readings.without_fine);
    CHECK(verdict(now(other), coarse) == Verdict::contradicted);
    CHECK(verdict(now(other), fine) == Verdict::contradicted);
    other = as_paper();
    for (FractalStudy& study : other.fractals) {
        study.reduced_response.contact_fraction *= 1.12;
        study.reduced_response.displacement *= 1.12; // K falls by as much
    }
    CHECK(verdict(now(other), alloy) == Verdict::undecidable);
    CHECK(verdict(now(other), area) == Verdict::undecidable);
}

TEST_CASE("p_max is larger than all pressures only where it is above the largest") {
    for (const double scale : {1.1, -1.1, 0.9, -0.9}) {
        PaperRun run;
        run.max_pressure = 3;
        run.database = {{waves_of({0}, 0.8, 2), of_area(0.1)}, {waves_of({0}, 0.8, scale), of_area(0.1)}};
        CHECK(verdict(series_claims(run, as_paper()), "p<sub>max</sub> is larger") ==
              (std::abs(scale) > 1 ? Verdict::reproduced : Verdict::contradicted));
    }
}

TEST_CASE("a part of the target is met better than the whole where a genome above 0.95 there is not so over "
          "all pressures") {
    const auto claims = [](const Scores& scores) {
        PaperRun run = run_of(5);
        TargetRun target;
        target.target.x = Eigen::Vector3d(1, 2, 3);
        target.target.y = Eigen::Vector3d(1, 1, 1);
        target.database = {scores, {0.1, 0.2, 0.3}};
        run.targets = {target, target};
        return series_claims(run, as_paper());
    };
    const std::string low = "A curve with s = 0.89", high = "A curve with s = 0.88";
    CHECK(verdict(claims({0.95, 0.96, 0.9}), low) == Verdict::reproduced);
    CHECK(verdict(claims({0.95, 0.96, 0.9}), high) == Verdict::contradicted);
    CHECK(verdict(claims({0.95, 0.9, 0.96}), low) == Verdict::contradicted);
    CHECK(verdict(claims({0.95, 0.9, 0.96}), high) == Verdict::reproduced);
}

TEST_CASE("as many children stand for two algorithms where the products of their parents are equal") {
    const auto equal = [](std::size_t first, std::size_t second) {
        TargetRun target;
        for (const double p_bar : {0.4, 0.5, 0.6})
            for (const char* name : {"gco", "cco"}) {
                ThresholdRow row;
                row.p_bar = p_bar;
                row.variant = name;
                row.u1 = row.variant == "gco" ? 6 : 3;
                row.u2 = row.variant == "gco" ? 2 : p_bar < 0.45 ? first : p_bar > 0.55 ? second : 4;
                target.thresholds.push_back(row);
            }
        PaperRun run;
        run.targets = {target, target};
        return verdict(search_claims(run), "|U<sub>3</sub>| is equal");
    };
    CHECK(equal(4, 4) == Verdict::reproduced);
    CHECK(equal(5, 4) == Verdict::contradicted);
    CHECK(equal(4, 5) == Verdict::contradicted);
}

TEST_CASE("the target's points are counted that lie among the database's curves") {
    PaperRun run = run_of(5);
    run.database[1].response.displacement /= 2; // K is 1, 2 and 3, and twice that
    const auto measured = [&](const Eigen::Vector3d& y) {
        TargetRun target;
        target.title = "drawn";
        target.target.x = Eigen::Vector3d(0.5, 2, 4.5);
        target.target.y = y;
        run.targets = {target};
        for (const Claim& claim : series_claims(run, as_paper()))
            if (claim.says.starts_with("The target's trend"))
                return claim.measured;
        return std::string();
    };
    CHECK(measured({1.5, 3, 4}).starts_with("drawn: 3 of 3"));
    CHECK(measured({0.9, 3, 4}).starts_with("drawn: 2 of 3"));
    CHECK(measured({1.5, 4.1, 6.1}).starts_with("drawn: 1 of 3"));
}

TEST_CASE("the Sobol pairs' discrepancy is the integral that defines it") {
    const PaperRun run = run_of(5);
    auto pairs = sobol_pairs(run.layout);
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
    for (const Claim& claim : series_claims(run, as_paper()))
        if (claim.place == "Figure 5") {
            CHECK(claim.verdict == Verdict::reproduced);
            CHECK_THAT(claim.measured,
                       Catch::Contains("discrepancy " + readable(std::sqrt(integral), 2) + ", lower"));
        }
}
