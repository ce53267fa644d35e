#include "domain/contact/solvers/choice.hpp"
#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/errors.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

/// 1 mm long, 0.25 mm high
Profile parabola(Index nodes) {
    Profile profile{Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes - 1)};
    for (Index i = 0; i < nodes; ++i)
        profile.heights[i] = -std::pow(static_cast<double>(i) * profile.spacing - 0.5, 2);
    return profile;
}

std::vector<double> steps_to(double displacement) {
    std::vector<double> steps;
    for (int j = 1; j <= 20; ++j)
        steps.push_back(displacement * j / 20);
    return steps;
}

ContactCurve pressed(Index nodes, double displacement, ContactOptions options = {}) {
    return solve_contact(parabola(nodes), Body{}, steps_to(displacement), options);
}

constexpr double most_touch = 0.3, few_touch = 1e-3; // displacements

} // namespace

TEST_CASE("auto takes the factor where few nodes touch and the active set where most of a fine grid do",
          "[contact]") {
    for (const Index nodes : {1024, 4096}) {
        const ContactCurve many = pressed(nodes, most_touch), few = pressed(nodes, few_touch);
        INFO(many.choice << "\n" << few.choice);
        CHECK(many.steps.back().contact_fraction > 0.6);
        CHECK(many.solver == Solver::active_set);
        CHECK(few.steps.back().contact_fraction < 0.1);
        CHECK(few.solver == Solver::nested);
    }
    CHECK(pressed(512, most_touch).solver == Solver::nested);
}

TEST_CASE("auto leaves the factor where it would not fit into memory, and says so", "[contact]") {
    ContactOptions options;
    CHECK(pressed(4096, few_touch, options).solver == Solver::nested);
    options.memory_limit = 1e4;
    const ContactCurve curve = pressed(4096, few_touch, options);
    CHECK(curve.solver == Solver::active_set);
    CHECK_THAT(curve.choice, Catch::Contains("the factor would not fit"));
}

TEST_CASE("a choice rests on the number of contact nodes that the curve will have, up to a factor of 1.6",
          "[contact]") {
    for (const Profile& profile : {scenes::database(4096)[7], scenes::database(4096)[61], parabola(4096)}) {
        const auto steps = scenes::load_steps(profile, 20, 0.6);
        const ContactCurve curve = solve_contact(profile, Body{}, steps, {});
        INFO(curve.choice);
        const double expected = std::stod(curve.choice.substr(curve.choice.find("about ") + 6));
        const auto found = static_cast<double>(curve.steps.back().contact_nodes);
        CHECK(expected > found / 1.6);
        CHECK(expected < found * 1.6);
    }
}

TEST_CASE("a periodic profile on a prime number of nodes is solved alike by both, up to near full contact",
          "[contact]") {
    for (const Index nodes : {509, 1021, 2039})
        for (const int waves : {1, 3, 40}) {
            Profile profile{Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes)};
            for (Index i = 0; i < nodes; ++i) {
                const double x = 6.283185307179586 * static_cast<double>(i) * profile.spacing;
                profile.heights[i] = std::cos(x) + 0.2 * std::cos(waves * x + 1);
            }
            Body body;
            body.kernel = Kernel::periodic;
            const double full = largest_displacement(profile, body);
            const std::vector<double> displacements{0.01 * full, 0.3 * full, 0.9 * full, 0.999 * full};
            ContactOptions nested, active_set;
            nested.solver = Solver::nested;
            active_set.solver = Solver::active_set;
            const ContactCurve exact = solve_contact(profile, body, displacements, nested),
                               found = solve_contact(profile, body, displacements, active_set);
            INFO(nodes << " nodes, " << waves << " waves");
            for (std::size_t j = 0; j < exact.steps.size(); ++j) {
                CHECK(found.steps[j].pressure == Approx(exact.steps[j].pressure).epsilon(1e-5));
                CHECK(found.steps[j].tangent_stiffness ==
                      Approx(exact.steps[j].tangent_stiffness).epsilon(1e-5));
                CHECK(found.steps[j].contact_nodes == exact.steps[j].contact_nodes);
            }
        }
}

TEST_CASE("the predicted cost grows with the grid, the load steps and the contact", "[contact]") {
    const double cost = predicted_cost(4096, 200, 20);
    CHECK(predicted_cost(8192, 200, 20) > cost);
    CHECK(predicted_cost(4096, 400, 20) > cost);
    CHECK(predicted_cost(4096, 200, 40) > cost);
    // Beyond some contact the active set is cheaper, which does not depend on it.
    CHECK(predicted_cost(4096, 4000, 20) == predicted_cost(4096, 4096, 20));
}

TEST_CASE("a spike that the choice's coarse grid would step over still holds the surface apart",
          "[contact]") {
    Profile profile = parabola(4096);
    profile.heights[2051] += 0.5;
    const SolverChoice choice = choose_solver(make_problem(profile, Body{}, {0.1, 0.2}), {});
    INFO(choice.reason);
    const double expected = std::stod(choice.reason.substr(choice.reason.find("about ") + 6));
    CHECK(expected == 8); // one node of 512
    CHECK(choice.solver == Solver::nested);
}

TEST_CASE("a factor is refused beforehand where the nodes that will touch do not fit, and only then",
          "[contact]") {
    ContactOptions options;
    const auto expected_to_fit = [&](double displacement) {
        expect_factor_to_fit(make_problem(parabola(4096), Body{}, steps_to(displacement)), options);
    };
    options.memory_limit = 1e-2 * GrowingFactor::bytes(4096);
    CHECK_NOTHROW(expected_to_fit(few_touch));
    CHECK_THROWS_AS(expected_to_fit(most_touch), InputError);
    options.memory_limit = GrowingFactor::bytes(4096);
    CHECK_NOTHROW(expected_to_fit(most_touch));
}
