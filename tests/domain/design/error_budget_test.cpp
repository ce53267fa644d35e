#include "domain/design/error_budget.hpp"
#include "domain/problem/setup.hpp"
#include "domain/target/like.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

Genome two_waves() { return {0.01, {{1, 0.8, 1.5, 2, {{1, {0.3}}, {2, {1.0}}}}}}; }

DesignSetup set_up(Kernel kernel = Kernel::free) {
    DesignSetup setup;
    setup.model.grid = {65, 2};
    setup.model.body.kernel = kernel;
    setup.model = completed(setup.model);
    setup.targets = {target_like(sample(two_waves(), setup.model.grid), setup.model, "a wave")};
    return setup;
}

Answer answered() {
    Answer answer{two_waves()};
    answer.similarity = 0.9;
    answer.similarity_refined = 0.8;
    return answer;
}

/// The answer's K at the target's points, pressed to the last of them.
Eigen::VectorXd curve_under(const DesignSetup& setup, Model model) {
    model.loading.to_pressure = setup.targets[0].last();
    const Curve curve = secant_stiffness(respond(sample(two_waves(), model.grid), model));
    return setup.targets[0].x.unaryExpr([&](double p) { return curve.at(p); });
}

} // namespace

TEST_CASE("an error budget says by how much the curve moves when one thing is changed, each by a solve") {
    const DesignSetup setup = set_up();
    const Eigen::VectorXd own = curve_under(setup, setup.model);
    const auto moved = [&](const Model& model) {
        return (curve_under(setup, model).array() / own.array() - 1).abs().maxCoeff();
    };
    const auto budget = error_budget(setup, answered());
    REQUIRE(budget.size() == 6);
    Model datum = setup.model;
    datum.body.datum *= 4;
    CHECK(budget[0].kind == "model");
    CHECK(budget[0].size == Approx(moved(datum)));
    CHECK(budget[0].size > 0.1);
    Model periodic = setup.model;
    periodic.body.kernel = Kernel::periodic;
    periodic.grid.periodic = true;
    periodic.loading.reach = 0.95;
    CHECK(budget[1].kind == "model");
    CHECK(budget[1].size == Approx(moved(periodic)));
    Model grid = setup.model;
    grid.grid = {4 * 64 + 1, 2};
    CHECK(budget[2].source == "the grid: 4 times the elements");
    CHECK(budget[2].size == Approx(moved(grid)));
    CHECK(budget[2].size > 0);
    Model steps = setup.model;
    steps.loading.steps = 80;
    CHECK(budget[3].kind == "numerical");
    CHECK(budget[3].size == Approx(moved(steps)));
    CHECK(budget[3].size > 0);
    CHECK(budget[4].kind == "target");
    CHECK(budget[4].size == Approx(0.1));
    CHECK(budget[5].size == Approx(0.2));
}
