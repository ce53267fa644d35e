#include "domain/contact/exact.hpp"
#include "domain/response/curve.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rough;

namespace {

/// A cylinder of radius 1 mm on 1 mm of half-plane.
Response cylinder(Index nodes, int steps) {
    Profile profile{Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes - 1)};
    for (Index i = 0; i < nodes; ++i)
        profile.heights[i] = -0.5 * std::pow(static_cast<double>(i) * profile.spacing - 0.5, 2);
    return respond(profile, {Kernel::free, 100, 1, 0}, {.steps = steps, .to_displacement = 0.03});
}

} // namespace

TEST_CASE("partial slip of a line contact is Cattaneo's and Mindlin's") { // c/a = sqrt(1 - Q/(f P))
    const double f = 0.4;
    const Response normal = cylinder(4001, 40);
    const PartialSlip slip = partial_slip(normal, f);
    REQUIRE(slip.traction.size() == 41);
    const double full = f * normal.pressure[39];
    for (Index k = 0; k <= 40; ++k) {
        INFO("row " << k); // the margin is a node's width of either contact
        CHECK(
            slip.stick_fraction[k] ==
            Approx(std::sqrt(1 - slip.traction[k] / full)).margin(2 / (normal.contact_fraction[39] * 4001)));
    }
    CHECK(slip.traction[0] == 0);
    CHECK(slip.displacement[0] == 0);
    CHECK(slip.stiffness[0] == normal.tangent_stiffness[39]);
    CHECK(slip.traction[40] == full);
    CHECK(slip.displacement[40] == f * normal.displacement[39]);
    CHECK(slip.stiffness[40] == 0);
    CHECK(slip.stick_fraction[40] == 0);
}

TEST_CASE("tangential stiffness is the slope of the slip curve and falls as slip spreads") {
    const PartialSlip slip = partial_slip(cylinder(2001, 200), 0.2);
    for (Index k = 1; k < 200; ++k) {
        const double secant =
            (slip.traction[k] - slip.traction[k - 1]) / (slip.displacement[k] - slip.displacement[k - 1]);
        CHECK(secant <= slip.stiffness[k - 1] * (1 + 1e-10));
        CHECK(secant >= slip.stiffness[k] * (1 - 1e-10));
    }
}
