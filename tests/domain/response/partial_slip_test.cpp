#include "domain/contact/exact.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/response/partial_slip.hpp"
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
    const Grid grid{128, 0.84942, false};
    const Genome genome = testing::random_genome(random, 1, 1, 0.84942, 8 * grid.spacing());
    const Loading loading{8, 0.7};
    const auto answer = respond_with_gradient(sample(genome, grid), {}, loading);
    const PartialSlipJacobian jacobian = partial_slip_jacobian(
        in_genes(answer.gradient,
                 [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, grid); }),
        0.3);
    const auto values = genes(genome);
    int kept = 0;
    for (std::size_t g = 0; g < values.size(); ++g) {
        auto up = values, down = values;
        up[g] += 1e-6;
        down[g] -= 1e-6;
        const Response right = respond(sample(with_genes(genome, up), grid), {}, loading),
                       left = respond(sample(with_genes(genome, down), grid), {}, loading);
        if (right.contact_fraction != left.contact_fraction)
            continue;
        ++kept;
        const PartialSlip more = partial_slip(right, 0.3), less = partial_slip(left, 0.3);
        const auto column = static_cast<Index>(g);
        CHECK(((more.traction - less.traction) / 2e-6 - jacobian.traction.col(column)).cwiseAbs().maxCoeff() <
              1e-5 * jacobian.traction.cwiseAbs().maxCoeff());
        CHECK(((more.displacement - less.displacement) / 2e-6 - jacobian.displacement.col(column))
                  .cwiseAbs()
                  .maxCoeff() <= 1e-5 * jacobian.displacement.cwiseAbs().maxCoeff());
    }
    CHECK(kept > 0);
}

TEST_CASE("no friction and held nodes have no partial slip") {
    Response normal = cylinder(101, 4);
    CHECK_THROWS_WITH(partial_slip(normal, 0), Catch::Contains("friction coefficient 0"));
    normal.held_nodes = 3;
    CHECK_THROWS_WITH(partial_slip(normal, 0.1), Catch::Contains("hardness"));
}
