#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/problem/drawn_start.hpp"
#include "tests/domain/design/setups.hpp"

#include <numbers>

using namespace rough;
using testing::like_itself;
using testing::two_waves;

namespace {

using testing::two_mm;

/// One wave of length `wave` (mm), a hill at the place that its phase gives.
Genome hill(double phase, double wave) { return {0.01, {{1, 0.8, 1.5, wave, {{1, {phase}}}}}}; }

TrustOptions without_draws() { return {.phase_draws = 0, .threads = 1}; }

bool flagged(const Trust& trust, const std::string& words) {
    return std::any_of(trust.flags.begin(), trust.flags.end(),
                       [&](const std::string& flag) { return flag.find(words) != std::string::npos; });
}

double answer(const std::vector<Check>& checks, const std::string& name) {
    for (const Check& check : checks)
        if (check.name == name) return check.similarity;
    FAIL("no check '" << name << "'");
    return 0;
}

Model with_kernel(Model model, Kernel kernel) {
    model.body.kernel = kernel;
    if (kernel == Kernel::periodic) model.loading.reach = 0.95;
    return completed(model);
}

} // namespace

TEST_CASE("each check is the similarity under the change that it names") {
    const Genome genome = two_waves();
    const DesignSetup setup = like_itself(genome);
    const Trust trust = trust_in(setup, genome, without_draws());
    const auto under = [&](const Model& changed) { return similarity(setup, respond(setup, genome, changed)); };
    REQUIRE(trust.checks.size() == 4);
    CHECK(trust.checks[0].name == "as designed");
    CHECK(trust.checks[0].similarity == under(setup.model));
    CHECK(trust.checks[0].similarity > 0.98);
    CHECK(answer(trust.checks, "4 times the nodes") == under(refined(setup.model, 4)));
    Model steps = setup.model;
    steps.loading.steps *= 64;
    CHECK(answer(trust.checks, "64 times the load steps") == under(steps));
    // The datum changes K by more than a tenth; a target moved with it is met as before.
    Model far = setup.model;
    *far.body.datum *= 4;
    CHECK(under(far) < 0.9);
    CHECK(answer(trust.checks, "4 times the datum, the target moved with it") > 0.98);
    REQUIRE(trust.kernels.size() == 2);
    for (const Kernel kernel : {Kernel::strip, Kernel::periodic})
        CHECK(answer(trust.kernels, name_of(kernel)) == under(with_kernel(setup.model, kernel)));
    CHECK(trust.left_out.empty());
    const Trust of_map = trust_in(testing::drawn(16, true), genome, without_draws());
    REQUIRE(of_map.kernels.size() == 1); // a map has no strip
    CHECK(of_map.kernels[0].name == name_of(Kernel::periodic));
}

TEST_CASE("targets moved with their datum are what a solve with that datum gives") {
    Model model;
    model.grid = {129, two_mm};
    model.body.effective_modulus = 2.5;
    model.body.datum = two_mm;
    const Profile profile = sample(two_waves(), model.grid);
    const double most = respond(profile, model).pressure.tail(1)[0];
    for (double share = 0.1; share < 0.85; share += 0.1) model.loading.pressures.push_back(share * most);
    Model far = model;
    far.body.datum = 4 * two_mm;
    const Response near_by = respond(profile, model), far_off = respond(profile, far);
    const auto check = [](const Response& from, const Response& to, const Model& of, double factor) {
        const Curve own = secant_stiffness(from), other = secant_stiffness(to);
        const Curve interface = interface_secants(from);
        const auto moved = with_datum({{Quantity::stiffness, "", own.x, own.y, own.y, own.y},
                                       {Quantity::load_at_displacement, "", from.displacement, from.pressure},
                                       {Quantity::area_at_pressure, "", from.pressure, from.contact_fraction},
                                       {Quantity::interface_stiffness, "", interface.x, interface.y}},
                                      of, factor);
        REQUIRE(moved.size() == 4);
        CHECK(moved[0].x.isApprox(other.x, 1e-9));
        for (const Eigen::VectorXd& values : {moved[0].y, moved[0].lower, moved[0].upper})
            CHECK(values.isApprox(other.y, 1e-6));
        CHECK(moved[1].x.isApprox(to.displacement, 1e-6));
        CHECK(moved[1].y == from.pressure);
        CHECK(moved[2].x == from.pressure);
        CHECK(moved[2].y == from.contact_fraction);
        CHECK(moved[2].y == to.contact_fraction);
        CHECK(moved[3].y == interface.y);
        CHECK(moved[3].y.isApprox(interface_secants(to).y, 1e-6));
    };
    check(near_by, far_off, model, 4);
    check(far_off, near_by, far, 0.25);
    CHECK(secant_stiffness(far_off).y[0] < 0.9 * secant_stiffness(near_by).y[0]);
}

TEST_CASE("noise and tilt that are given are checks that decide") {
    const Genome genome = two_waves();
    DesignSetup setup = like_itself(genome);
    for (const double size : {1e-10, 1e-3}) {
        setup.errors = {size, 0.1, size};
        const Trust trust = trust_in(setup, genome, without_draws());
        REQUIRE(trust.checks.size() == 6);
        for (const std::size_t i : {4u, 5u}) {
            CHECK(trust.checks[i].decides);
            CHECK((trust.checks[i].similarity > trust.checks[0].similarity - 1e-4) == (size < 1e-6));
        }
        CHECK(trust.under == std::min(trust.checks[4].similarity, trust.checks[5].similarity));
        CHECK(trust.under == similarity_under_errors(setup, genome));
    }
}

TEST_CASE("a hardness below the highest node pressure at the last load step is flagged") {
    const Genome genome = two_waves();
    const DesignSetup setup = like_itself(genome);
    const Trust without = trust_in(setup, genome, without_draws());
    const Profile profile = sample(genome, setup.model.grid);
    const double to = displacement_at_pressure(profile, setup.model.body, setup.targets[0].last());
    const ContactCurve curve = solve_contact(profile, setup.model.body, {to}, {.states = true, .stop = {}});
    CHECK(without.peak_pressure == Approx(curve.states[0].pressure.maxCoeff()).epsilon(1e-6));
    CHECK(!flagged(without, "hardness"));
    for (const double factor : {0.999, 1.001}) {
        TrustOptions options = without_draws();
        options.hardness = factor * without.peak_pressure;
        const Trust trust = trust_in(setup, genome, options);
        CHECK(flagged(trust, "hardness") == (factor < 1));
        if (factor < 1) // hardly any node is held
            CHECK(answer(trust.checks, "nodes held at the hardness") == Approx(1).margin(0.01));
    }
}

TEST_CASE("contact at an end is flagged, except on a periodic body") {
    const double pi = std::numbers::pi;
    const auto trusted = [](const Genome& genome, Kernel kernel) {
        return trust_in(like_itself(genome, 0.05, kernel), genome, without_draws());
    };
    for (const Kernel kernel : {Kernel::free, Kernel::strip})
        for (const auto& [genome, at_end] : {std::pair(hill(pi, 2 * two_mm), true), // highest at x = 0
                                             std::pair(hill(0, 2 * two_mm), true),  // at the other end
                                             std::pair(hill(0, two_mm), false)}) {  // in the middle
            const Trust trust = trusted(genome, kernel);
            CHECK(trust.contact_at_ends == at_end);
            CHECK(flagged(trust, "ends") == at_end);
        }
    CHECK(!trusted(hill(pi, two_mm), Kernel::periodic).contact_at_ends);
}

TEST_CASE("redrawn phases give the same similarities on any number of threads") {
    const DesignSetup setup = like_itself(two_waves());
    TrustOptions options{.phase_draws = 5, .seed = 3, .threads = 1};
    const Trust trust = trust_in(setup, two_waves(), options);
    REQUIRE(trust.redrawn.size() == 5);
    CHECK(std::ranges::max(trust.redrawn) < trust.checks[0].similarity);
    CHECK(std::ranges::min(trust.redrawn) < std::ranges::max(trust.redrawn));
    options.threads = 2;
    CHECK(trust_in(setup, two_waves(), options).redrawn == trust.redrawn);
}

TEST_CASE("redrawn phases are spread evenly around the circle") {
    const DesignSetup setup = like_itself(hill(0, two_mm));
    const double at_one = similarity(setup, with_fitting_amplitude(setup, hill(1, two_mm)));
    const auto all = trust_in(setup, hill(0, two_mm), {.phase_draws = 300, .threads = 1}).redrawn;
    const auto nearer = std::ranges::count_if(all, [&](double each) { return each > at_one; });
    CHECK(nearer == Approx(300 / std::numbers::pi).margin(24)); // turns of -1 to 1, three standard errors
}

TEST_CASE("checks without time are named as left out and count nowhere") {
    const Trust trust =
        trust_in(like_itself(two_waves()), two_waves(), {.phase_draws = 5, .threads = 1, .seconds = -1});
    CHECK(trust.checks.empty());
    CHECK(trust.kernels.empty());
    CHECK(trust.redrawn.empty());
    REQUIRE(trust.left_out.size() == 4 + 2 + 1);
    CHECK(trust.left_out.front() == "as designed");
    CHECK(trust.left_out.back() == "5 sets of redrawn phases");
}

TEST_CASE("a steep slope and a wave of fewer than eight nodes are flagged") {
    for (const double scale : {0.05, 0.5})
        for (const int nodes : {17, 19, 65}) { // 7.1, 8 and 28 nodes for the shortest wave
            Genome genome = two_waves(0.3, 1, scale);
            genome.series[0].chromosomes.push_back({3, {0.5}});
            DesignSetup setup = like_itself(genome);
            setup.model.grid.nodes = nodes;
            const Trust trust = trust_in(setup, genome, without_draws());
            const Eigen::VectorXd z = sample(genome, {4097, two_mm}).heights;
            const double slope = 32 * (z.tail(4096) - z.head(4096)).norm(); // of all, spacing 1/2048 mm
            CHECK(trust.rms_slope == Approx(slope).epsilon(0.05));
            CHECK(flagged(trust, "assumes small slopes") == (slope > 0.1));
            CHECK(flagged(trust, "the grid is part of the answer") == (nodes == 17));
        }
}
