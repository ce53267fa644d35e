#include "domain/design/statistical.hpp"
#include "domain/errors.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

const std::string search =
    "sample 30 | score | until evaluations 1500 { l-shade evaluations=1500 | score | duel } | best 1";

/// The curve that a theory predicts for known parameters as target.
StatisticalTask predicted_target(Quantity quantity) {
    StatisticalTask task;
    task.nodes = 96;
    task.target.quantity = quantity;
    task.target.x = Eigen::VectorXd::LinSpaced(6, 1e-3, 2e-2);
    const TheoryCurve curve =
        predicted_curve(task.theory, random_surface({0.7, 0.4, 0.12, 0.08}), 1, task.target.x);
    task.target.y = is_contact_fraction(quantity) ? curve.contact_fraction : curve.stiffness;
    return task;
}

} // namespace

TEST_CASE("a design without heights finds parameters whose predicted curve is the target", "[statistical]") {
    for (const Quantity quantity : {Quantity::stiffness, Quantity::area_at_pressure}) {
        const StatisticalTask task = predicted_target(quantity);
        const StatisticalAnswer answer = statistical_design(task, search, 3, 1);
        CHECK(answer.similarity > 0.995);
        CHECK(answer.evaluations <= 1600);
        if (quantity == Quantity::area_at_pressure) // the only parameter in Persson's contact area
            CHECK(answer.parameters.rms_slope == Approx(0.08).epsilon(0.01));
        const StatisticalAnswer same = statistical_design(task, search, 3, 2);
        CHECK(same.parameters.hurst == answer.parameters.hurst);
        CHECK(same.similarity == answer.similarity);
    }
}

TEST_CASE("a realised answer has the requested slope and an exact curve", "[statistical]") {
    const StatisticalTask task = predicted_target(Quantity::stiffness);
    const StatisticalAnswer answer = statistical_design(task, search, 1, 1);
    const RealisedAnswer exact = realised_answer(task, answer.parameters, 2);
    CHECK(rms_slope(random_surface(exact.surface, true)) ==
          Approx(answer.parameters.rms_slope).epsilon(1e-9));
    CHECK(exact.similarity > 0.5);
    CHECK(exact.similarity < answer.similarity);
}
