#include "domain/contact/exact.hpp"
#include "domain/response/partial_slip.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rough;

namespace {

/// A cylinder of radius 1 mm on 1 mm of half-plane.
Response cylinder(Index nodes, int steps) {
    Profile profile{Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes - 1)};
    for (Index i = 0; i < nodes; ++i)
        profile.heights[i] = -0.5 * std::pow(static_cast<double>(i) * profile.spacing - 0.5, 2);
    Loading loading;
    loading.steps = steps;
    loading.to_displacement = 0.03;
    return respond(profile, {Kernel::free, 100, 1, 0}, loading);
}

} // namespace

TEST_CASE("a line contact in partial slip is Cattaneo's and Mindlin's: c/a = sqrt(1 - Q/(f P))") {
    const double f = 0.4;
    const Response normal = cylinder(4001, 40);
    const PartialSlip slip = partial_slip(normal, f);
    REQUIRE(slip.traction.size() == 41);
    const double full = f * normal.pressure[39];
    for (Index k = 0; k <= 40; ++k) {
        INFO("row " << k);
        // a node's width of either contact
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

TEST_CASE("the slip curve's derivatives follow central differences in every gene") {
    std::mt19937_64 random(61);
    Model model;
    model.grid = {128, 0.84942, false};
    model.loading = {8, 0.7};
    const Genome genome = testing::random_genome(random, 1, 1, 0.84942, 8 * model.grid.spacing());
    const PartialSlipJacobian jacobian = partial_slip_jacobian(testing::jacobian_of(genome, model), 0.3);
    testing::check_derivatives(
        genome, model,
        {{jacobian.traction, [](const Response& normal) { return partial_slip(normal, 0.3).traction; }},
         {jacobian.displacement,
          [](const Response& normal) { return partial_slip(normal, 0.3).displacement; }}});
}
