#include "domain/contact/solvers/certificate.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

/// The residual of a state's pressures, H applied by the path the nested solver does not take.
double residual(const ContactProblem& problem, double approach, const std::vector<int>& nodes,
                const Eigen::VectorXd& pressure) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.nodes());
    all(nodes) = pressure;
    const Eigen::VectorXd displacement = SplitOperator(problem.column, problem.shape).apply(all);
    return certify(problem, approach, nodes, pressure, displacement.data()).residual();
}

} // namespace

TEST_CASE("a correct solution changed by a millionth fails its certificate", "[contact]") {
    constexpr double direct_tolerance = 1e-9;
    for (const auto& scene : scenes::reference_curves()) {
        INFO(scene.name);
        const ContactCurve curve = solve_contact(scene.profile, scene.body, scene.displacement, {.states = true});
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

/// Five nodes, the first three in contact at half of the largest displacement, in the problem's units.
struct Pressed {
    ContactProblem problem =
        make_problem({(Eigen::VectorXd(5) << 0, -0.1, -0.2, -0.3, -3).finished(), 0.25}, Body{}, {0.5, 1});
    double approach = 0.5;
    std::vector<int> contact{0, 1, 2};
    Eigen::VectorXd pressure = Eigen::Vector3d(0.5, 1, 0.5);
    Eigen::VectorXd displacement = (Eigen::VectorXd(5) << 0.5, 0.4, 0.3, 0.25, 0).finished();
    double mean = pressure.sum() / problem.elements; ///< mean pressure of the exact state

    Certificate certified() const { return certify(problem, approach, contact, pressure, displacement.data()); }
};

/// Returns a function that changes the exact state, with pressures up to `cap`, and checks its certificate.
auto corruption(double cap) {
    return [cap](auto change, const Certificate& expected) {
        Pressed state;
        state.problem.cap = cap;
        change(state);
        const Certificate found = state.certified();
        CHECK(found.gap == Approx(expected.gap).margin(1e-14));
        CHECK(found.penetration == Approx(expected.penetration).margin(1e-14));
        CHECK(found.tension == Approx(expected.tension).margin(1e-14));
        CHECK(found.excess == Approx(expected.excess).margin(1e-14));
    };
}

} // namespace

TEST_CASE("a certificate reports each corruption by its size over approach or mean pressure", "[contact]") {
    const auto corrupt = corruption(HUGE_VAL);
    corrupt([](Pressed&) {}, {});
    corrupt([](Pressed& state) { state.displacement[1] += 0.05; }, {.gap = 0.1}); // a gap in contact
    corrupt([](Pressed& state) { state.displacement[1] -= 0.05; }, {.gap = 0.1, .penetration = 0.1});
    corrupt([](Pressed& state) { state.displacement[3] = 0.2 - 0.05; }, {.penetration = 0.1}); // off contact
    corrupt([](Pressed& state) { state.pressure = Eigen::Vector3d(1, -0.2, 1.2); }, {.tension = 0.2 / Pressed().mean});
}

TEST_CASE("a certificate is infinite when a pressure or displacement is not finite", "[contact]") {
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

TEST_CASE("nodes at the hardness may penetrate, but have no gap and no more pressure", "[contact]") {
    const auto corrupt = corruption(1); // the pressure of node 1
    corrupt([](Pressed&) {}, {});
    corrupt([](Pressed& state) { state.displacement[1] -= 0.05; }, {});
    corrupt([](Pressed& state) { state.displacement[1] += 0.05; }, {.gap = 0.1});
    corrupt([](Pressed& state) { state.pressure = Eigen::Vector3d(0.4, 1.1, 0.5); }, {.excess = 0.1 / Pressed().mean});
}
