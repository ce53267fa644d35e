#include "domain/design/trust.hpp"
#include "domain/response/curve.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

constexpr double L = 2;

Target target_of(Quantity quantity, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    Target target;
    target.quantity = quantity;
    target.x = x;
    target.y = y;
    return target;
}

} // namespace

TEST_CASE(
    "targets moved with their datum are what a solve with that datum gives, nearer as well as farther") {
    Model model;
    model.grid = {129, L};
    model.body.effective_modulus = 2.5;
    model.body.datum = L;
    const Profile profile = sample({0.01, {{1, 0.8, 1.5, L, {{1, {0.3}}, {2, {1.0}}}}}}, model.grid);
    const double most = respond(profile, model).pressure.tail(1)[0];
    for (double share = 0.1; share < 0.85; share += 0.1)
        model.loading.pressures.push_back(share * most);
    Model far = model;
    far.body.datum = 4 * L;
    const Response near_by = respond(profile, model), far_off = respond(profile, far);
    const auto check = [](const Response& from, const Response& to, const Model& of, double factor) {
        const Curve own = secant_stiffness(from), other = secant_stiffness(to);
        Target stiffness = target_of(Quantity::stiffness, own.x, own.y);
        stiffness.lower = own.y;
        stiffness.upper = own.y;
        const Target load = target_of(Quantity::load_at_displacement, from.displacement, from.pressure);
        const Target area = target_of(Quantity::area_at_pressure, from.pressure, from.contact_fraction);
        const Curve interface = curve_of(Quantity::interface_stiffness, from);
        const auto moved = with_datum(
            {stiffness, load, area, target_of(Quantity::interface_stiffness, interface.x, interface.y)}, of,
            factor);
        REQUIRE(moved.size() == 4);
        CHECK(moved[3].y == interface.y);
        CHECK(moved[3].y.isApprox(curve_of(Quantity::interface_stiffness, to).y, 1e-6));
        CHECK(moved[0].x.isApprox(other.x, 1e-9));
        CHECK(moved[0].y.isApprox(other.y, 1e-6));
        CHECK(moved[0].lower.isApprox(other.y, 1e-6));
        CHECK(moved[0].upper.isApprox(other.y, 1e-6));
        CHECK(moved[1].x.isApprox(to.displacement, 1e-6));
        CHECK(moved[1].y == from.pressure);
        CHECK(moved[2].x == from.pressure);
        CHECK(moved[2].y == from.contact_fraction);
        CHECK((from.contact_fraction - to.contact_fraction).isZero());
    };
    check(near_by, far_off, model, 4);
    check(far_off, near_by, far, 0.25);
    CHECK(secant_stiffness(far_off).y[0] < 0.9 * secant_stiffness(near_by).y[0]);
}
