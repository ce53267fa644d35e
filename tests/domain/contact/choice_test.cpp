#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

/// 1 mm long, 0.25 mm high
Profile parabola(Index nodes) {
    return sampled({nodes, 1}, [](double x) { return -(x - 0.5) * (x - 0.5); });
}

std::vector<double> steps_to(double displacement) {
    return scenes::load_steps(sampled({2, 1}, [](double x) { return x; }), 20, displacement);
}

ContactCurve pressed(Index nodes, double displacement, ContactOptions options = {}) {
    return solve_contact(parabola(nodes), Body{}, steps_to(displacement), options);
}

/// Raised nodes on a flat or wavy periodic profile, 1 mm long.
Profile raised(Index nodes, const std::vector<Index>& where, double height, double wave = 0) {
    Profile profile = sampled({nodes, 1, true}, [&](double x) { return wave * std::cos(6.283185307179586 * x); });
    for (const Index i : where) profile.heights[i] += height;
    return profile;
}

const Body periodic{Kernel::periodic, 1, 1, 0};

/// 3,000 nodes on 1 mm, waves of amplitudes k^-decay, 1 um high.
Profile rough_line(int waves, double decay, double chirp, double cubic) {
    Profile profile = sampled({3000, 1, true}, [&](double x) {
        double z = 0;
        for (int k = 1; k < waves; ++k)
            z += std::pow(k, -decay) *
                 std::cos(6.283185307179586 * (k * x + std::fmod(k * k * (cubic * k + chirp), 1.0)));
        return z;
    });
    profile.heights *= 1e-3 / (profile.heights.maxCoeff() - profile.heights.minCoeff());
    return profile;
}

constexpr double most_nodes_touch = 0.3, few_touch = 1e-3; // displacements

} // namespace

TEST_CASE("auto takes nested if few nodes touch, active-set if most of a fine grid do", "[contact]") {
    for (const Index nodes : {1024, 4096}) {
        const ContactCurve many = pressed(nodes, most_nodes_touch), few = pressed(nodes, few_touch);
        CHECK(many.steps.back().contact_fraction > 0.6);
        CHECK(many.solver == Solver::active_set);
        CHECK(few.steps.back().contact_fraction < 0.1);
        CHECK(few.solver == Solver::nested);
    }
    CHECK(pressed(512, most_nodes_touch).solver == Solver::nested);
}

TEST_CASE("auto takes active-set when the factor would not fit", "[contact]") {
    const ContactCurve curve = pressed(4096, few_touch, {.memory_limit = 1e4});
    CHECK(curve.solver == Solver::active_set);
}

TEST_CASE("nested and active-set agree on a prime number of nodes, up to near full contact", "[contact]") {
    for (const Index nodes : {509, 1021, 2039})
        for (const int waves : {1, 40}) {
            const Profile profile = sampled({nodes, 1, true}, [&](double x) {
                return std::cos(6.283185307179586 * x) + 0.2 * std::cos(waves * 6.283185307179586 * x + 1);
            });
            const double full = largest_displacement(profile, periodic);
            const std::vector<double> displacements{0.01 * full, 0.3 * full, 0.9 * full, 0.999 * full};
            const ContactCurve exact = solve_contact(profile, periodic, displacements, {.solver = Solver::nested});
            const ContactCurve found = solve_contact(profile, periodic, displacements, {.solver = Solver::active_set});
            INFO(nodes << " nodes, " << waves << " waves");
            scenes::check_same(found, exact, 1e-5);
        }
}

TEST_CASE("the curve stays the same when a factor hands over for work or memory", "[contact]") {
    // Every eighth node is a pit: the sample that predicts the contact sees hardly anything else.
    Profile profile = raised(4096, {}, 0, 1e-6);
    for (Index i = 0; i < 4096; i += 8) profile.heights[i] -= i == 2048 ? 0 : 1e-3;
    std::vector<double> steps;
    const double full = profile.heights.maxCoeff() - profile.heights.mean();
    for (const double part : {0.002, 0.005, 0.01, 0.5, 0.9}) steps.push_back(part * full);
    const ContactCurve direct = solve_contact(profile, periodic, steps, {.solver = Solver::nested});
    for (const double memory : {2e9, 4e6}) {
        const ContactCurve curve = solve_contact(profile, periodic, steps, {.memory_limit = memory});
        INFO("memory limit " << memory);
        CHECK(curve.steps.front().kkt_residual < 1e-12); // the factor has solved it
        CHECK(curve.solver == Solver::active_set);
        REQUIRE(curve.steps.size() == steps.size());
        for (std::size_t j = 0; j < steps.size(); ++j) {
            CHECK(curve.steps[j].pressure == Approx(direct.steps[j].pressure).epsilon(3e-6));
            CHECK(curve.steps[j].displacement == steps[j]);
        }
    }
}

TEST_CASE("a rough periodic profile passes its certificate near full contact", "[contact]") {
    std::mt19937_64 random(51);
    std::normal_distribution<double> normal;
    Profile profile{Eigen::VectorXd(4097), 1.0 / 4097};
    for (double& height : profile.heights) height = normal(random);
    const double full = profile.heights.maxCoeff() - profile.heights.mean();
    for (const Solver solver : {Solver::nested, Solver::automatic}) {
        const ContactCurve curve = solve_contact(profile, periodic, {0.9 * full, 0.9999 * full}, {.solver = solver});
        CHECK(curve.steps.back().contact_fraction > 0.5);
        CHECK(curve.steps.back().kkt_residual < (solver == Solver::nested ? 1e-8 : 2e-6));
    }
}

TEST_CASE("auto presses a rough line to a list of loads near full contact", "[contact]") {
    const Profile profile = rough_line(300, 1.6, 8 * 0.41421, 0.6180339887); // active-set fails
    std::vector<double> loads;
    for (const double share : {0.999, 0.9999, 0.99999, 0.999999})
        loads.push_back(share * full_contact_load(profile, periodic));
    const ContactCurve curve = solve_contact_at_pressures(profile, periodic, loads);
    for (std::size_t j = 0; j < loads.size(); ++j) CHECK(std::abs(curve.steps[j].pressure / loads[j] - 1) < 1e-5);
}

TEST_CASE("active-set and auto press lines under stiff layers as nnls does", "[contact]") {
    const Profile profile = rough_line(120, 2, 1.168, 0);
    Body body{Kernel::periodic, effective_modulus(1, 0.3)};
    body.layering = {{{0.00156, 1150, 0.3}}, false, 0.3};
    std::vector<double> steps = scenes::load_steps(profile, 3, 0.4);
    const ContactCurve expected = solve_contact(profile, body, steps, {.solver = Solver::nnls});
    for (const Solver solver : {Solver::automatic, Solver::active_set})
        scenes::check_same(solve_contact(profile, body, steps, {.solver = solver}), expected, 1e-5);
}
