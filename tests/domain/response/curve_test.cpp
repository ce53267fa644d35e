#include "domain/contact/kernel.hpp"
#include "tests/domain/contact/exact.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using testing::random_genome;
using testing::uniform;

namespace {

using testing::paper_length;

Response pressed(const Profile& profile, const Body& body, const std::vector<double>& displacements, Solver solver) {
    const ContactCurve curve = solve_contact(profile, body, displacements, {.solver = solver, .stop = {}});
    return response_of(curve.steps, curve.solver, displacement_range(profile, body.kernel),
                       full_contact_stiffness(profile, body));
}

/// A cylinder of radius 1 mm on 1 mm of a body.
Profile cylinder(Index nodes) {
    return sampled({nodes, 1}, [](double x) { return -0.5 * std::pow(x - 0.5, 2); });
}
const Body half_plane{Kernel::free, 100, 1, 0};
Response pressed_cylinder(Index nodes, int steps) {
    return respond(cylinder(nodes), half_plane, {.steps = steps, .to_displacement = 0.03});
}

} // namespace

TEST_CASE("full contact is as stiff as a flat profile by the direct solver, on any grid") {
    for (const Index nodes : {2, 3, 17, 100, 511, 2048})
        for (const double datum : {0.26 + 0.5 / static_cast<double>(nodes - 1), 1.0, 40.0})
            for (const Kernel kernel : {Kernel::free, Kernel::strip}) {
                const Profile flat{Eigen::VectorXd::Zero(nodes), paper_length / static_cast<double>(nodes - 1)};
                const Body body{kernel, 3, datum * paper_length, 0.1 * datum * paper_length};
                const double direct =
                    solve_contact(flat, body, {1}, {.solver = Solver::nested, .stop = {}}).steps[0].tangent_stiffness;
                INFO(nodes << " nodes, datum " << datum);
                const double full = full_contact_stiffness(flat, body);
                CHECK(std::abs(1 / full - 1 / direct) <= 1e-11 / direct);
            }
    const Profile flat{Eigen::VectorXd::Zero(64), 0.1};
    CHECK(std::isinf(full_contact_stiffness(flat, {Kernel::periodic, 1, 1, 0})));
    CHECK_THROWS_WITH(full_contact_stiffness(flat, {Kernel::free, 1, 1, 0}), Catch::Contains("datum"));
}

TEST_CASE("interface stiffness does not depend on the datum, tangents and secants") {
    std::mt19937_64 random(31);
    double worst = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Solver solver = trial % 3 ? Solver::nested : Solver::nnls;
        const Grid grid{std::uniform_int_distribution<Index>(40, 400)(random), paper_length, false};
        const Profile profile = sample(random_genome(random, 1, 1, paper_length, 8 * grid.spacing()), grid);
        const Body near{Kernel::free, 1, paper_length * uniform(random, 0.3, 2), 0};
        Body far = near;
        far.datum = paper_length * std::pow(10, uniform(random, -0.5, 4));
        const std::vector<double> displacements =
            load_displacements(displacement_range(profile, near.kernel), {}, near.kernel);
        const Response one = pressed(profile, near, displacements, solver);
        std::vector<double> moved;
        for (Index j = 0; j < one.steps(); ++j) // equal contact sets
            moved.push_back(one.displacement[j] - one.pressure[j] * datum_sensitivity(1, paper_length, 1) *
                                                      std::log(*far.datum / *near.datum));
        const Response other = pressed(profile, far, moved, solver);
        REQUIRE(one.contact_fraction == other.contact_fraction);
        const auto compare = [&](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, const Eigen::ArrayXd& K) {
            worst = std::max(worst, ((1 / a - 1 / b) * K).abs().maxCoeff());
        };
        compare(interface_stiffness(one), interface_stiffness(other), one.tangent_stiffness);
        compare(interface_secants(one).y, interface_secants(other).y, secant_stiffness(one).y);
        CHECK((interface_stiffness(one) - one.tangent_stiffness).minCoeff() > 0);
    }
    CHECK(worst <= 1e-12);
}

TEST_CASE("interface stiffness is K on a periodic half-plane and infinite at full contact") {
    std::mt19937_64 random(32);
    Model model;
    model.grid = {128, paper_length, true};
    model.body.kernel = Kernel::periodic;
    model.loading.reach = 0.9;
    const Response periodic = respond(random_genome(random, 1, 1, paper_length, 0.1), model);
    CHECK(interface_stiffness(periodic) == periodic.tangent_stiffness);
    CHECK(interface_secants(periodic).y == secant_stiffness(periodic).y);
    const Profile bowl{1e-6 * Eigen::VectorXd::LinSpaced(64, -1, 1).cwiseAbs2(), paper_length / 63};
    for (const Solver solver : {Solver::nested, Solver::active_set}) {
        const Response full = pressed(bowl, {Kernel::free, 1, paper_length, 0}, {1e-8, 1, 2}, solver);
        REQUIRE(full.contact_fraction[1] == 1);
        CHECK(std::isfinite(interface_stiffness(full)[0]));
        CHECK(std::isinf(interface_stiffness(full)[1]));
        CHECK(interface_secants(full).y.allFinite());
        CHECK(interface_secants(full).y[2] > 1e5);
    }
    CHECK_THROWS(interface_stiffness(response_of(std::vector<LoadStep>(2), Solver::nested, 1)));
}

TEST_CASE("the interface's secants follow central differences in every gene") {
    std::mt19937_64 random(33);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Model model;
        model.grid = {128, paper_length, kernel == Kernel::periodic};
        model.body.kernel = kernel;
        model.body.strip_width = 0.002;
        model.loading = {10, 0.6};
        const Genome genome = random_genome(random, 1, 1, paper_length, 8 * model.grid.spacing());
        const Response response = respond(genome, model);
        const CurveJacobian jacobian =
            interface_jacobian(secant_jacobian(response, testing::jacobian_of(genome, model)),
                               secant_stiffness(response), response.full_stiffness);
        testing::check_derivatives(genome, model,
                                   {{jacobian.y, [](const Response& each) { return interface_secants(each).y; }}});
    }
}

TEST_CASE("partial slip of a line contact is Cattaneo's and Mindlin's") { // c/a = sqrt(1 - Q/(f P))
    const double f = 0.4;
    const Response normal = pressed_cylinder(4001, 40);
    const PartialSlip slip = partial_slip(cylinder(4001), half_plane, normal, f);
    REQUIRE(slip.traction.size() == 41);
    const double full = f * normal.pressure[39];
    for (Index k = 0; k <= 40; ++k) {
        INFO("row " << k); // the margin is a node's width of either contact
        CHECK(slip.stick_fraction[k] ==
              Approx(std::sqrt(1 - slip.traction[k] / full)).margin(2 / (normal.contact_fraction[39] * 4001)));
    }
    CHECK((slip.traction[0] == 0 && slip.traction[40] == full));
    CHECK((slip.displacement[0] == 0 && slip.displacement[40] == f * normal.displacement[39]));
    CHECK((slip.stiffness[0] == normal.tangent_stiffness[39] && slip.stiffness[40] == 0));
    CHECK(slip.stick_fraction[40] == 0);
}

TEST_CASE("tangential stiffness is the slope of the slip curve and falls as slip spreads") {
    const PartialSlip slip = partial_slip(cylinder(2001), half_plane, pressed_cylinder(2001, 200), 0.2);
    for (Index k = 1; k < 200; ++k) {
        const double secant =
            (slip.traction[k] - slip.traction[k - 1]) / (slip.displacement[k] - slip.displacement[k - 1]);
        CHECK(secant <= slip.stiffness[k - 1] * (1 + 1e-10));
        CHECK(secant >= slip.stiffness[k] * (1 - 1e-10));
    }
}
