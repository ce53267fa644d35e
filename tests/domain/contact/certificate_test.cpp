#include "domain/contact/solvers/certificate.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace rough;

namespace {

/// The residual of a state's pressures, H applied by the path the nested solver does not take.
double residual(const ContactProblem& problem, double approach, const std::vector<int>& nodes,
                const Eigen::VectorXd& pressure) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.nodes());
    all(nodes) = pressure;
    const Eigen::VectorXd displacement = SplitOperator(problem.column).apply(all);
    return certify(problem, approach, nodes, pressure, displacement.data()).residual();
}

} // namespace

TEST_CASE("a correct solution changed by a millionth no longer passes its certificate", "[contact]") {
    constexpr double direct_tolerance = 1e-9;
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name);
        ContactOptions options;
        options.states = true;
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacement, options);
        const ContactProblem problem = make_problem(scene.profile, scene.body, scene.displacement);
        for (std::size_t j = 0; j < curve.steps.size(); ++j) {
            const auto& nodes = curve.states[j].nodes;
            const Eigen::VectorXd p = curve.states[j].pressure / problem.pressure_unit;
            const double approach = problem.approach[j];
            CHECK(residual(problem, approach, nodes, p) < 1e-12);
            CHECK(residual(problem, approach, nodes, p * (1 + 1e-6)) > direct_tolerance);
            CHECK(residual(problem, approach * (1 + 1e-6), nodes, p) > direct_tolerance);
            for (Index k = 0; k < p.size(); k += 1 + p.size() / 4) {
                Eigen::VectorXd one = p;
                one[k] += 1e-6 * p.mean();
                CHECK(residual(problem, approach, nodes, one) > direct_tolerance);
            }
            std::vector<int> fewer(nodes.begin() + 1, nodes.end());
            CHECK(residual(problem, approach, fewer, p.tail(p.size() - 1)) > direct_tolerance);
        }
    }
}

namespace {

/// Five nodes, the first three in contact at half of the largest displacement, in the problem's own units.
struct Pressed {
    ContactProblem problem =
        make_problem({(Eigen::VectorXd(5) << 0, -0.1, -0.2, -0.3, -3).finished(), 0.25}, Body{}, {0.5, 1});
    double approach = 0.5;
    std::vector<int> contact{0, 1, 2};
    Eigen::VectorXd pressure = Eigen::Vector3d(0.5, 1, 0.5);
    Eigen::VectorXd displacement = (Eigen::VectorXd(5) << 0.5, 0.4, 0.3, 0.25, 0).finished();

    Certificate certified() const {
        return certify(problem, approach, contact, pressure, displacement.data());
    }
};

void check(const Certificate& found, const Certificate& expected) {
    CHECK(found.gap == Approx(expected.gap).margin(1e-14));
    CHECK(found.penetration == Approx(expected.penetration).margin(1e-14));
    CHECK(found.tension == Approx(expected.tension).margin(1e-14));
    CHECK(found.excess == Approx(expected.excess).margin(1e-14));
    CHECK(found.residual() ==
          Approx(std::max({expected.gap, expected.penetration, expected.tension, expected.excess}))
              .margin(1e-14));
}

} // namespace

TEST_CASE("a certificate reports each corruption alone, and by its own size over the approach or the mean",
          "[contact]") {
    const Pressed exact;
    const double mean = exact.pressure.sum() / exact.problem.elements;
    check(exact.certified(), {});
    SECTION("a contact node that hangs in the air") {
        Pressed wrong;
        wrong.displacement[1] += 0.05;
        check(wrong.certified(), {.gap = 0.1});
    }
    SECTION("a contact node that sinks in") {
        Pressed wrong;
        wrong.displacement[1] -= 0.05;
        check(wrong.certified(), {.gap = 0.1, .penetration = 0.1});
    }
    SECTION("a node off contact that sinks in") {
        Pressed wrong;
        wrong.displacement[3] = 0.2 - 0.05;
        check(wrong.certified(), {.penetration = 0.1});
    }
    SECTION("a node that is left out of the contact set") {
        Pressed wrong;
        wrong.contact = {0, 2};
        wrong.pressure = Eigen::Vector2d(1, 1);
        wrong.displacement[1] = 0.4 - 0.02;
        check(wrong.certified(), {.penetration = 0.04});
    }
    SECTION("a node that is pulled") {
        Pressed wrong;
        wrong.pressure = Eigen::Vector3d(1, -0.2, 1.2);
        check(wrong.certified(), {.tension = 0.2 / mean});
    }
    SECTION("nothing but pull has no scale") {
        Pressed wrong;
        wrong.pressure = Eigen::Vector3d(0, -1, 0);
        CHECK(std::isinf(wrong.certified().tension));
    }
    SECTION("a number that is none") {
        for (const double none : {std::nan(""), std::numeric_limits<double>::infinity()})
            for (const Index node : {0, 4}) {
                Pressed wrong;
                wrong.displacement[node] = none;
                CHECK(std::isinf(wrong.certified().residual()));
            }
        Pressed wrong;
        wrong.pressure[2] = std::nan("");
        CHECK(std::isinf(wrong.certified().residual()));
    }
}

TEST_CASE("under a hardness held nodes may sink in, but neither hang in the air nor bear more", "[contact]") {
    const auto pressed = [] {
        Pressed state;
        state.problem.cap = 1;
        return state;
    };
    const Pressed exact = pressed();
    const double mean = exact.pressure.sum() / exact.problem.elements;
    check(exact.certified(), {});
    Pressed state = pressed();
    state.displacement[1] -= 0.05;
    check(state.certified(), {});
    state = pressed();
    state.displacement[1] += 0.05;
    check(state.certified(), {.gap = 0.1});
    state = pressed();
    state.displacement[0] -= 0.05; // an elastic node
    check(state.certified(), {.gap = 0.1, .penetration = 0.1});
    state = pressed();
    state.displacement[3] = 0.2 - 0.05;
    check(state.certified(), {.penetration = 0.1});
    state = pressed();
    state.pressure = Eigen::Vector3d(1, 0.5, 1); // the first and the last are held
    state.displacement[0] -= 0.05;
    state.displacement[2] -= 0.1;
    check(state.certified(), {});
    state = pressed();
    state.pressure = Eigen::Vector3d(0.4, 1.1, 0.5);
    check(state.certified(), {.excess = 0.1 / mean});
}
