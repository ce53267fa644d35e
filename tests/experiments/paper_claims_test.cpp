#include "experiments/paper/paper.hpp"
#include "tests/catch.hpp"

using namespace app;

namespace {

constexpr double L = 2;

const Claim& claim_of(const std::string& id) {
    for (const Claim& claim : paper_claims())
        if (claim.id == id) return claim;
    throw std::runtime_error("no claim " + id);
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

VariantRun variant(const std::string& name, const rough::Genome& genome, double area = 0.1, double similarity = 0.96) {
    VariantRun run;
    run.name = name;
    run.answer = {genome, response_of_area(area)};
    run.similarity = similarity;
    run.seconds = 60;
    return run;
}

PaperRun run_with(const std::vector<TargetRun>& targets) {
    PaperRun run;
    run.model.grid = {64, L, true};
    run.max_pressure = 6;
    run.targets = targets;
    return run;
}

std::string verdict(const std::string& id, const std::vector<TargetRun>& targets, const Studies& studies = {}) {
    const auto findings = findings_of(claim_of(id), run_with(targets), studies);
    return verdict_of(claim_of(id), rough::column(findings, &Finding::number));
}
std::string verdict(const std::string& id, const TargetRun& target) {
    return verdict(id, std::vector<TargetRun>{target, target});
}

TargetRun answers(VariantRun sog, VariantRun gco, VariantRun cco) {
    TargetRun target;
    target.variants = {std::move(sog), std::move(gco), std::move(cco)};
    return target;
}

const std::string yes = "reproduced", no = "contradicted", open = "undecidable";

} // namespace

TEST_CASE("a condition decides on its bound as it is written") {
    const auto decided = [](const char* reproduced, const char* contradicted, double number) {
        return verdict_of({"", "", "", "", "", reproduced, contradicted, ""}, {number});
    };
    const char* const within = ">= 30 and <= 120";
    CHECK(decided(within, "> 120", 30) == yes);
    CHECK(decided(within, "> 120", 120) == yes);
    CHECK(decided(within, "> 120", 29.9) == open);
    CHECK(decided(within, "> 120", 120.1) == no);
    CHECK(decided("< 2", "otherwise", 1.9) == yes);
    CHECK(decided("< 2", "otherwise", 2) == no);
    CHECK(decided("= 1", "otherwise", 1) == yes);
    CHECK(decided("= 1", "otherwise", 2) == no);
    CHECK(decided("> 0", "never", 0) == open);
}

TEST_CASE("targets that differ, or an unknown number, leave a claim undecidable") {
    for (const Claim& claim : paper_claims()) {
        CHECK(verdict_of(claim, {}) == open);
        CHECK(verdict_of(claim, {NAN}) == open);
        for (const double number : {-1., 0., 0.5, 1., 2., 50., 1e9}) {
            CHECK(verdict_of(claim, {number, NAN}) == open);
            CHECK(verdict_of(claim, {number, number}) == verdict_of(claim, {number}));
        }
    }
    CHECK(verdict_of(claim_of("large"), {0.95, 0.85}) == open);
}

TEST_CASE("a run without searches and studies has no verdict on any claim") {
    for (const auto& targets : {std::vector<TargetRun>{}, std::vector<TargetRun>(2)})
        for (const Claim& claim : paper_claims()) {
            INFO(claim.id);
            CHECK(verdict(claim.id, targets) == (claim.id == "even-pairs" ? yes : open)); // always there
        }
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

TEST_CASE("a spectrum matches the genome's waves unless the profile has other waves, too") {
    const std::vector<double> phases{0.1, 1.2, 2.3, 0.4, 1.5};
    const auto with = [&](const rough::Genome& genome) {
        return answers(variant("sog", genome), variant("gco", genome), variant("cco", waves_of(phases, -0.5)));
    };
    const TargetRun periodic = with(waves_of(phases));
    CHECK(verdict("match-high", periodic) == yes);
    CHECK(verdict("differ-low", periodic) == no);
    CHECK(verdict("extra-peaks", periodic) == no);
    CHECK(verdict("cco-flat", periodic) == yes); // density k^-(2H + 1)
    CHECK(verdict("cco-flat", answers(variant("sog", {}), variant("gco", {}), variant("cco", waves_of(phases)))) == no);
    // Longer waves than the profile are in its spectrum, but not in the octaves of its genome.
    rough::Genome aliased = waves_of(phases);
    aliased.series.push_back({10, 0.8, 2, L / 40, {{1, {0.7}}}}); // beyond the Nyquist wavenumber, seen at 24
    CHECK(verdict("extra-peaks", with(aliased)) == yes);
    CHECK(verdict("match-high", with(aliased)) == no);
}

TEST_CASE("CCO's spectrum is proportional to SOG's if one factor fits all its lower octaves") {
    const std::vector<double> phases{0.1, 1.2, 2.3, 0.4, 1.5};
    rough::Genome scaled = waves_of(phases);
    scaled.scale = 3;
    const auto with = [&](const rough::Genome& cco) {
        return answers(variant("sog", waves_of(phases)), variant("gco", {}), variant("cco", cco));
    };
    CHECK(verdict("cco-proportional", with(scaled)) == yes);
    CHECK(verdict("cco-proportional", with(waves_of(phases, -0.8))) == no); // steeper by k^-3.2
}

TEST_CASE("claims on the search are decided by each algorithm, by similarities and by seconds") {
    const auto searched = [](double cco_after, double seconds) {
        TargetRun target;
        for (const char* name : {"sog", "gco", "cco"}) {
            VariantRun run = variant(name, waves_of({0}));
            const double after = run.name == "cco" ? cco_after : 0.9;
            run.stages = {{run.name + "/score.1", {{1, {}, 0.7}, {2, {}, 0.5}}},
                          {run.name + "/refine.1", {{1, {}, after}, {2, {}, 0.6}}}};
            run.seconds = seconds;
            target.variants.push_back(run);
        }
        return target;
    };
    CHECK(verdict("beneficial", searched(0.8, 60)) == yes);
    CHECK(verdict("beneficial", searched(0.7, 60)) == no); // the second candidate alone gains
    CHECK(verdict("minute", searched(0.8, 60)) == yes);
    CHECK(verdict("minute", searched(0.8, 0.13)) == open);
    CHECK(verdict("minute", searched(0.8, 300)) == no);
    const auto swept = [](double gco, double cco, double spread) {
        TargetRun target;
        for (const double more : {0.0, spread})
            for (const char* name : {"gco", "cco"}) {
                const double similarity = name[0] == 'g' ? gco : cco;
                target.thresholds.push_back(
                    {{"variant", name}, {"share_above", 0}, {"best_child", 0.8 + more}, {"similarity", similarity}});
            }
        return target;
    };
    CHECK(verdict("efficient", swept(0.9, 0.8, 0)) == yes);
    CHECK(verdict("efficient", swept(0.8, 0.9, 0)) == no);
    CHECK(verdict("gco-varies", swept(0.9, 0.8, 0.02)) == yes);
    CHECK(verdict("gco-varies", swept(0.9, 0.8, 0.005)) == no);
    CHECK(verdict("cco-steady", swept(0.9, 0.8, 0.02)) == no);
}

TEST_CASE("verdicts on formulas and parts of a genome turn when their numbers do") {
    Studies studies;
    studies.chromosomes = {{0.1, 1e-15}, {0.0666, 1e-14}};
    studies.ridges = {{2, 0.9, 0.9, 0.995}, {8, 0.97, 0.9, 0.995}};
    GenomeStudy genome{.dominant = {0.3, 0.92}, .without_coarse = {2, 0.1}, .without_fine = {0.1, 2}};
    genome.contacts = {100, 1};
    studies.genomes = {genome};
    studies.fractals = {{1, 0}};
    const std::vector<std::string> ids{"nesting",         "one-wave",      "wavelength",       "condition",
                                       "arccos",          "part-suffices", "coarse-stiffness", "fine-area",
                                       "alloy-stiffness", "alloy-area"};
    for (const std::string& id : ids) CHECK(verdict(id, {}, studies) == yes);
    studies.chromosomes = {{0.1, 2e-12}, {0.0668, 0}};
    studies.ridges[1] = {8, 1, 0.9, 0.5};
    studies.genomes = {{.dominant = {0.3, 0.4}, .without_coarse = {0.1, 2}, .without_fine = {2, 0.1}}};
    studies.genomes[0].contacts.nodes = 100;
    studies.fractals = {{0.88, 0.12}};
    for (const std::string& id : ids) // another profile than the alloy's cannot contradict
        CHECK(verdict(id, {}, studies) == (id.starts_with("alloy") ? open : no));
    for (const Reduction& undecided : {Reduction{0.3, 0.7}, {1, 0.95}}) { // the second keeps all chromosomes
        studies.genomes[0].dominant = undecided;
        CHECK(verdict("part-suffices", {}, studies) == open);
    }
}

TEST_CASE("a part of the target is met better than the whole by a genome that is poor over all pressures") {
    TargetRun target;
    target.database = {{0.96, 0.99, 0.97}, {0.95, 0.96, 0.9}, {0.88, 0.89, 0.94}};
    CHECK(best_in_part(target, &Scores::low) == 1);
    CHECK(best_in_part(target, &Scores::high) == 2);
    CHECK(verdict("low-part", target) == yes);
    CHECK(verdict("high-part", target) == no);
    target.database.resize(1);
    CHECK(verdict("low-part", target) == open);
}
