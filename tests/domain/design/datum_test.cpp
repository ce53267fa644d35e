#include "domain/design/trust.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/similarity.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("targets moved with the datum are what the same profile answers there, at the same pressures") {
    std::mt19937_64 random(61);
    Model model;
    model.grid.nodes = 128;
    model = completed(model);
    for (int step = 1; step <= 10; ++step)
        model.loading.pressures.push_back(2e-5 * step);
    const Profile profile = sample(testing::random_genome(random, 1, 1, model.grid.length, 0.1), model.grid);
    const Response near = respond(profile, model);
    Model far = model;
    far.body.datum *= 4;
    const Response there = respond(profile, far);
    for (const Quantity quantity : {Quantity::stiffness, Quantity::interface_stiffness,
                                    Quantity::area_at_pressure, Quantity::load_at_displacement}) {
        const Curve curve = curve_of(quantity, near);
        Target target;
        target.quantity = quantity;
        target.x = curve.x.tail(9);
        target.y = curve.y.tail(9);
        const auto moved = with_datum({target}, model, 4);
        INFO("quantity " << int(quantity));
        REQUIRE(moved.size() == 1);
        CHECK(similarity(moved[0], curve_of(quantity, there)) == Approx(1).margin(1e-8));
        const bool stays =
            quantity == Quantity::interface_stiffness || quantity == Quantity::area_at_pressure;
        CHECK((moved[0].x == target.x && moved[0].y == target.y) == stays);
    }
}
