#include "domain/contact/solvers/certificate.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

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

TEST_CASE("a certificate names penetration, tension and a number that is none", "[contact]") {
    const Profile profile{Eigen::Vector3d(0, -0.1, -3), 0.5};
    const ContactProblem problem = make_problem(profile, Body{}, {1});
    const Eigen::Vector3d far(1, 1, 1), near(1, 0.2, 0);
    const std::vector<int> first{0};
    const Eigen::VectorXd push = Eigen::VectorXd::Ones(1);
    CHECK(certify(problem, 1, first, push, far.data()).residual() == 0);
    CHECK(certify(problem, 1, first, push, near.data()).penetration == Approx(0.7));
    CHECK(certify(problem, 1, {0, 1}, Eigen::Vector2d(1, -0.1), Eigen::Vector3d(1, 0.9, 1).data()).tension ==
          Approx(0.1 / (0.9 / 2)));
    const Eigen::Vector3d none(1, std::nan(""), 1);
    CHECK(std::isinf(certify(problem, 1, first, push, none.data()).residual()));
}
