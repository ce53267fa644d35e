#include "domain/contact/solvers/solvers.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace rough;

TEST_CASE("NNLS drops what an earlier step pressed and the next does not bear", "[contact]") {
    const auto pressures = [](const StepSolution& step) {
        std::map<int, double> at;
        for (std::size_t k = 0; k < step.nodes.size(); ++k)
            at[step.nodes[k]] = step.pressure[static_cast<Index>(k)];
        return at;
    };
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        const Profile profile = scenes::database(120)[0];
        ContactProblem problem = make_problem(profile, {kernel, 1.0}, scenes::load_steps(profile, 9, 0.3));
        Solution pressed, released;
        solve_nnls(problem, {}, pressed);
        std::reverse(problem.approach.begin(), problem.approach.end());
        solve_nnls(problem, {}, released); // from the most nodes to the fewest
        const std::size_t n = problem.approach.size();
        REQUIRE(pressed.steps.back().nodes.size() > pressed.steps.front().nodes.size() + 8);
        for (std::size_t k = 0; k < n; ++k) {
            const auto up = pressures(pressed.steps[k]), down = pressures(released.steps[n - 1 - k]);
            REQUIRE(up.size() == down.size());
            const double most = pressed.steps[k].pressure.maxCoeff();
            for (const auto& [node, pressure] : up)
                CHECK(down.at(node) == Approx(pressure).margin(1e-9 * most));
            CHECK(released.steps[n - 1 - k].stiffness == Approx(pressed.steps[k].stiffness).epsilon(1e-9));
        }
    }
}
