#include "domain/contact/names.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/like.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace rough;

namespace {

constexpr double L = 2;

/// One wave of length `wave`, mm: a hill where its phase puts it.
Genome hill(double phase, double wave = L, double scale = 0.01) {
    return {scale, {{1, 0.8, 1.5, wave, {{1, {phase}}}}}};
}
Genome two_waves(double scale = 0.01) { return {scale, {{1, 0.8, 1.5, L, {{1, {0.3}}, {2, {1.0}}}}}}; }

/// The genome's own K(p) as target, up to a part of what it carries.
DesignSetup like_itself(const Genome& genome, double part = 1, Kernel kernel = Kernel::free) {
    DesignSetup setup;
    setup.model.grid = {65, L};
    setup.model.body.kernel = kernel;
    setup.model = completed(setup.model);
    const Profile profile = sample(genome, setup.model.grid);
    const double last = secant_stiffness(respond(profile, setup.model)).to;
    setup.targets = {target_like(profile, setup.model, "itself", Quantity::stiffness, 10, part * last)};
    return setup;
}

TrustOptions without_draws() { return {.phase_draws = 0, .threads = 1}; }

bool flagged(const Trust& trust, const std::string& words) {
    return std::any_of(trust.flags.begin(), trust.flags.end(),
                       [&](const std::string& flag) { return flag.find(words) != std::string::npos; });
}

double answer(const std::vector<Check>& checks, const std::string& name) {
    for (const Check& check : checks)
        if (check.name == name)
            return check.similarity;
    FAIL("no check '" << name << "'");
    return 0;
}

} // namespace

TEST_CASE("each check of trust is the similarity under the one change that it names") {
    const Genome genome = two_waves();
    const DesignSetup setup = like_itself(genome);
    const Model& model = setup.model;
    const Trust trust = trust_in(setup, genome, without_draws());
    const auto under = [&](const Model& changed) {
        return similarity(setup, respond(setup, genome, changed));
    };
    REQUIRE(trust.checks.size() == 5);
    CHECK(trust.checks[0].name == "as designed");
    CHECK(trust.checks[0].similarity == under(model));
    CHECK(trust.checks[0].similarity > 0.98);
    CHECK(answer(trust.checks, "2 times the nodes") == under(refined(model, 2)));
    CHECK(answer(trust.checks, "4 times the nodes") == under(refined(model, 4)));
    Model steps = model;
    steps.loading.steps *= 4;
    CHECK(answer(trust.checks, "4 times the load steps") == under(steps));
    // Moved with its datum the target is met as before; the datum alone moves K by more than a tenth.
    Model far = model;
    far.body.datum *= 4;
    CHECK(under(far) < 0.9);
    CHECK(answer(trust.checks, "4 times the datum, the target moved with it") > 0.98);
    REQUIRE(trust.kernels.size() == 2);
    Model strip = model;
    strip.body.kernel = Kernel::strip;
    CHECK(answer(trust.kernels, name_of(Kernel::strip)) == under(completed(strip)));
    const auto values = column(trust.checks, &Check::similarity);
    CHECK(trust.median == quantile(values, 0.5));
    CHECK(trust.tenth == quantile(values, 0.1));
    CHECK(trust.tenth < trust.median);
    CHECK(trust.left_out.empty());
}

TEST_CASE("where Eq. 11 applies the datum moves at the genome's own amplitude, and reach stays the body's") {
    const Genome genome = two_waves();
    DesignSetup setup = like_itself(genome);
    setup.max_pressure = setup.targets[0].last();
    const Trust trust = trust_in(setup, genome, without_draws());
    CHECK(trust.checks[0].similarity > 0.98);
    CHECK(answer(trust.checks, "4 times the datum, the target moved with it") > 0.98);
    Model periodic = setup.model;
    periodic.body.kernel = Kernel::periodic;
    periodic.loading.reach = 0.95;
    CHECK(answer(trust.kernels, name_of(Kernel::periodic)) ==
          similarity(setup, respond(setup, genome, completed(periodic))));
}

TEST_CASE("a given noise and tilt are checks that decide") {
    const Genome genome = two_waves();
    DesignSetup setup = like_itself(genome);
    for (const double size : {1e-10, 1e-3}) {
        setup.errors = {size, 0.1, size};
        const Trust trust = trust_in(setup, genome, without_draws());
        REQUIRE(trust.checks.size() == 7);
        for (const std::size_t i : {5, 6}) {
            CHECK(trust.checks[i].decides);
            CHECK((trust.checks[i].similarity > trust.checks[0].similarity - 1e-4) == (size < 1e-6));
        }
        CHECK(trust.under == std::min(trust.checks[5].similarity, trust.checks[6].similarity));
        CHECK(trust.under == similarity_when_made(setup, genome));
    }
}

TEST_CASE("a hardness is flagged where the highest node pressure at the last load step is above it") {
    const Genome genome = two_waves();
    const DesignSetup setup = like_itself(genome);
    const Trust without = trust_in(setup, genome, without_draws());
    ContactOptions states;
    states.states = true;
    const Profile profile = sample(genome, setup.model.grid);
    const double to = displacement_at_pressure(profile, setup.model.body, setup.targets[0].last());
    const ContactCurve curve = solve_contact(profile, setup.model.body, {to}, states);
    CHECK(without.peak_pressure == Approx(curve.states[0].pressure.maxCoeff()).epsilon(1e-6));
    CHECK(!flagged(without, "hardness"));
    for (const double factor : {0.999, 1.001}) {
        TrustOptions options = without_draws();
        options.hardness = factor * without.peak_pressure;
        const Trust trust = trust_in(setup, genome, options);
        CHECK(flagged(trust, "hardness") == (factor < 1));
        if (factor < 1) // hardly anything flows
            CHECK(answer(trust.checks, "nodes held at the hardness") == Approx(1).margin(0.01));
    }
}

TEST_CASE("contact at one end is flagged, at either, but in the middle or on a periodic body it is not") {
    const double pi = std::numbers::pi;
    const auto trusted = [](const Genome& genome, Kernel kernel) {
        return trust_in(like_itself(genome, 0.05, kernel), genome, without_draws());
    };
    for (const Kernel kernel : {Kernel::free, Kernel::strip}) {
        CHECK(trusted(hill(pi, 2 * L), kernel).contact_at_ends); // highest at x = 0
        CHECK(trusted(hill(0, 2 * L), kernel).contact_at_ends);  // at x = L
        CHECK(flagged(trusted(hill(0, 2 * L), kernel), "ends"));
        CHECK(!trusted(hill(0), kernel).contact_at_ends); // at L/2
        CHECK(!flagged(trusted(hill(0), kernel), "ends"));
    }
    CHECK(!trusted(hill(pi), Kernel::periodic).contact_at_ends);
}

TEST_CASE("phases drawn anew are summed up by best, median and tenth, the same on any threads") {
    const DesignSetup setup = like_itself(two_waves());
    TrustOptions options = without_draws();
    options.phase_draws = 5;
    options.seed = 3;
    const Trust trust = trust_in(setup, two_waves(), options);
    CHECK(trust.redrawn == 5);
    CHECK(trust.redrawn_tenth < trust.redrawn_median);
    CHECK(trust.redrawn_median < trust.redrawn_best);
    CHECK(trust.redrawn_best < trust.checks[0].similarity);
    CHECK(trust.left_out.empty());
    options.threads = 2;
    CHECK(trust_in(setup, two_waves(), options).redrawn_median == trust.redrawn_median);
}

TEST_CASE("a likeness that hangs on the load steps is flagged, a profile's likeness with itself is not") {
    const Genome genome = two_waves();
    DesignSetup setup = like_itself(genome);
    const TrustOptions options = without_draws();
    setup.like = sample(genome, setup.model.grid);
    const Trust itself = trust_in(setup, genome, options);
    const std::string name = "4 times the load steps, for the target too";
    CHECK(answer(itself.checks, name) > 0.99);
    CHECK(!flagged(itself, "load steps"));
    setup.like->heights = setup.like->heights.cwiseAbs2() / 0.01; // that its targets are not of
    const Trust another = trust_in(setup, genome, options);
    CHECK(answer(another.checks, name) < another.checks[0].similarity - 0.01);
    CHECK(flagged(another, "load steps"));
}

TEST_CASE("what there was no time for is left out by name and counts nowhere") {
    const Genome genome = two_waves();
    TrustOptions options = without_draws();
    options.phase_draws = 5;
    options.seconds = -1; // over before it began
    const Trust trust = trust_in(like_itself(genome), genome, options);
    CHECK(trust.checks.size() + trust.kernels.size() + trust.left_out.size() ==
          5 + 2 + (trust.redrawn < 5 ? 1u : 0u));
    CHECK(trust.redrawn == 0);
    CHECK(trust.checks.empty());
    REQUIRE(!trust.left_out.empty());
    CHECK(trust.left_out.front() == "as designed");
    CHECK(trust.left_out.back() == "5 of the phases drawn anew");
    CHECK(std::isnan(trust.median));
    CHECK(std::isnan(trust.redrawn_best));
}
