#include "domain/contact/kernel.hpp"
#include "domain/target/out_of_reach.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

#include <Eigen/LU>

using namespace rough;

namespace {

Model model_on(Kernel kernel, Index nodes, int steps) {
    Model model;
    model.grid.nodes = nodes;
    model.body.kernel = kernel;
    model.loading = {steps, kernel == Kernel::periodic ? 0.9 : 1};
    return completed(model);
}

/// A punch whose flank is the dent that its raised end node makes at `depth`, a logarithm. Until there only
/// that node touches, and then all nodes.
Profile dented_punch(const Model& model, double depth) {
    const Grid& grid = model.grid;
    const double delta = grid.spacing();
    const auto h = influence_column(in_units(model.body, delta, 0), grid.shape());
    Profile profile{Eigen::VectorXd(grid.nodes), delta};
    for (Index i = 0; i < grid.nodes; ++i) profile.heights[i] = depth * h[i] / h[0];
    return profile;
}

/// Random profiles of six kinds.
Profile scene(const Model& model, int kind, std::mt19937_64& random) {
    const Grid& grid = model.grid;
    std::uniform_real_distribution<double> unit(0, 1);
    Profile profile = dented_punch(model, 1e-3 * unit(random));
    const auto anywhere = [&] { return static_cast<Index>(unit(random) * static_cast<double>(grid.nodes)); };
    switch (kind % 6) {
    case 1: // with a groove, so that the full approach goes beyond the dent
        profile.heights[anywhere()] -= 1e-3 * unit(random);
        break;
    case 2: // a flat with spikes
        profile.heights.setZero();
        for (int spike = 0; spike < 3; ++spike) profile.heights[anywhere()] += 1e-3 * unit(random);
        break;
    case 3: // steps
        for (Index i = 0; i < grid.nodes; ++i)
            profile.heights[i] = 1e-3 * std::floor(4 * static_cast<double>(i) / static_cast<double>(grid.nodes));
        profile.heights[anywhere()] += 1e-3 * unit(random);
        break;
    case 4: // noise on a flat
        for (double& z : profile.heights) z = 1e-3 * std::pow(unit(random), 8);
        break;
    case 5:
        profile = sample(testing::random_genome(random, 1, 1, grid.length, 0.02), grid);
        break;
    default:
        break;
    }
    return profile;
}

/// A curve's values as a target at even points.
Target read_off(const Curve& curve, Quantity quantity, Index points) {
    return target_at(quantity, "the profile's response", PointPlacement{points}.up_to(curve.to),
                     [&](double x) { return curve.at(x); });
}

} // namespace

TEST_CASE("the response of a punch shaped like a dent is not out of reach") {
    Model model = model_on(Kernel::free, 512, 20);
    constexpr double depth = 2e-5;
    model.loading.to_displacement = depth * 20 / 19;
    const Profile profile = dented_punch(model, depth);
    const Response response = respond(profile, model.body, model.loading);
    const Target target = read_off(secant_stiffness(response), Quantity::stiffness, 20);
    // The scored curve is continued above full contact, as far as any curve can be.
    const StiffnessLimits secants = stiffness_limits(model);
    REQUIRE(target.y[19] > 1.6 * secants.max);
    CHECK(target.y[19] == Approx(scored_limits(secants, 20, 1).max).epsilon(0.01));
    CHECK((out_of_reach({target}, model).empty() && out_of_reach({target}, model, target.last()).empty()));
    Target stiffer = target;
    stiffer.y *= 1.2;
    const auto found = out_of_reach({stiffer}, model);
    REQUIRE(found.size() == 1);
    CHECK(found[0].bound == Approx(1 / 1.2).epsilon(0.02));
    CHECK(found[0].verdict().find('\n') == std::string::npos);
    // If the load ends later, the curve is not continued there.
    CHECK_FALSE(out_of_reach({target}, model, 2 * target.last()).empty());
}

TEST_CASE("no response is out of reach, and no profile exceeds the bound of a bent one") {
    std::mt19937_64 random(51);
    std::normal_distribution<double> bend;
    double nearest = 1;
    int verdicts = 0;
    for (int trial = 0; trial < 180; ++trial) {
        const int steps = std::array{2, 3, 5, 20, 80}[static_cast<std::size_t>(trial) % 5];
        const Model model = model_on(static_cast<Kernel>(trial % 3), 60 + trial % 7, steps);
        const Response response = respond(scene(model, trial / 15, random), model.body, model.loading, model.contact);
        for (const Quantity quantity : {Quantity::stiffness, Quantity::area_at_pressure, Quantity::area_at_displacement,
                                        Quantity::load_at_displacement, Quantity::interface_stiffness}) {
            INFO("trial " << trial << ", steps " << steps << ", quantity " << static_cast<int>(quantity));
            const Curve curve = curve_of(quantity, response);
            const Target own = read_off(curve, quantity, 5 + trial % 30);
            if (own.y.minCoeff() <= 0) continue;
            CHECK(out_of_reach({own}, model).empty());
            Target bent = own;
            for (double& y : bent.y) y *= std::exp((trial % 2 ? 0.02 : 0.5) * bend(random));
            if (trial % 4 == 3) bent.lower = 0.95 * bent.y, bent.upper = 1.1 * bent.y;
            for (const OutOfReach& one : out_of_reach({bent}, model)) {
                CHECK(similarity(bent, curve) <= one.bound + 1e-9);
                nearest = std::min(nearest, one.bound - similarity(bent, curve));
                ++verdicts;
            }
        }
    }
    CHECK(verdicts > 100);
    CHECK(nearest < 0.05); // otherwise the bounds could be trivial
}

TEST_CASE("interface stiffness may exceed full contact, but not fall or be below one node") {
    const Model model = model_on(Kernel::free, 128, 20);
    const StiffnessLimits limits = stiffness_limits(model);
    const auto target_of = [](double first, double second) {
        return Target{Quantity::interface_stiffness, "", Eigen::Vector2d(1e-5, 1e-4), Eigen::Vector2d(first, second)};
    };
    CHECK(out_of_reach({target_of(1, 1000 * limits.max)}, model).empty());
    const auto falls = out_of_reach({target_of(2, 1)}, model);
    REQUIRE(falls.size() == 1);
    CHECK_THAT(falls[0].reason, Catch::StartsWith("interface stiffness falls"));
    CHECK(falls[0].bound == Approx(2.0 / 3));
    // One node's K is its K_i in series with the half-plane's, so K_i is the larger.
    const double one_node = 1 / (1 / limits.min - 1 / limits.max);
    CHECK(out_of_reach({target_of(1.001 * one_node, 1)}, model).empty());
    const auto soft = out_of_reach({target_of(0.5 * (limits.min + one_node), 1)}, model);
    REQUIRE(soft.size() == 1);
    CHECK(soft[0].bound == Approx(2 - one_node / (0.5 * (limits.min + one_node)))); // with K_i of one node
    CHECK_THAT(soft[0].verdict(),
               Catch::Contains("on this grid") && Catch::Contains("single node") && !Catch::Contains("even as"));
}

TEST_CASE("a map's lowest stiffness is that of one node", "[areas]") {
    for (const Index n : {32, 256}) {
        Model model;
        model.grid = {.nodes = n, .length = 1, .rows = n, .width = 1};
        const StiffnessLimits limits = stiffness_limits(model);
        Profile needle{Eigen::VectorXd::Zero(n * n), model.grid.spacing(), n, model.grid.row_spacing()};
        needle.heights[n * n / 2 + n / 2] = 1;
        const LoadStep alone = solve_contact(needle, model.body, {1e-3}).steps[0];
        CHECK(alone.contact_nodes == 1);
        CHECK(limits.min == Approx(alone.tangent_stiffness));
        CHECK(limits.max > limits.min);
    }
}

TEST_CASE("a load curve above a chord is out of reach by its exact distance") {
    const Model model = model_on(Kernel::free, 128, 20);
    const double unit = 0.25e-5 * stiffness_limits(model).max; // at most half of the slope of full contact
    Target target{Quantity::load_at_displacement, "", Eigen::Vector3d(1e-5, 2e-5, 3e-5),
                  unit * Eigen::Vector3d(1, 3, 4)};
    const auto found = out_of_reach({target}, model);
    REQUIRE(found.size() == 1);
    // P_2 (1 - e) = ((1 + e) P_1 + (1 + e) P_3)/2
    CHECK(found[0].bound == Approx(1 - 0.5 / 5.5).epsilon(1e-12));
    CHECK(found[0].at == std::vector<double>{2e-5});
    target.y = unit * Eigen::Vector3d(1, 2.4, 4);
    CHECK(out_of_reach({target}, model).empty());
}

TEST_CASE("no response of a map is out of reach, and the verdict on a bent one names maps", "[areas]") {
    std::mt19937_64 random(53);
    std::normal_distribution<double> height, bend;
    int verdicts = 0;
    for (int trial = 0; trial < 40; ++trial) {
        Model model{.grid = {.nodes = 9, .length = 0.5, .rows = 7, .width = 0.5 + 0.1 * (trial % 4)},
                    .body = {trial % 2 ? Kernel::periodic : Kernel::free}};
        model.loading = {8, trial % 2 ? 0.9 : 1};
        model = completed(model);
        Profile map{Eigen::VectorXd(63), model.grid.spacing(), 7, model.grid.row_spacing()};
        for (double& z : map.heights) z = 1e-3 * height(random);
        const Response response = respond(map, model.body, model.loading);
        for (const Quantity quantity :
             {Quantity::stiffness, Quantity::area_at_pressure, Quantity::load_at_displacement}) {
            const Curve curve = curve_of(quantity, response);
            Target own = read_off(curve, quantity, 12);
            if (own.y.minCoeff() <= 0) continue;
            CHECK(out_of_reach({own}, model).empty());
            for (double& y : own.y) y *= std::exp(0.3 * bend(random));
            for (const OutOfReach& one : out_of_reach({own}, model)) {
                CHECK(similarity(own, curve) <= one.bound + 1e-9);
                CHECK_THAT(one.verdict(), Catch::StartsWith("out of reach of every map"));
                CHECK((one.verdict().find("proven without a grid") != std::string::npos) == (trial % 2 == 1));
                ++verdicts;
            }
        }
    }
    CHECK(verdicts > 20);
}

// H is then the inverse of a matrix with no positive entry off its diagonal, and so is each of its parts.
// Every contact set has w > 0, and none loses a node.
TEST_CASE("the inverse of a free map's influence has negative entries off its diagonal", "[areas]") {
    for (const double ratio : {0.1, 1.0, 3.0}) {
        const Grid grid{.nodes = 14, .length = 1, .rows = 12, .width = ratio};
        const Eigen::VectorXd column =
            influence_column(in_units(Body{Kernel::free}, grid.spacing(), grid.row_spacing()), grid.shape());
        const Index n = grid.shape().nodes();
        Eigen::MatrixXd inverse = Eigen::MatrixXd::NullaryExpr(n, n, [&](Index a, Index b) {
                                      return column[std::abs(a / 14 - b / 14) * 14 + std::abs(a % 14 - b % 14)];
                                  }).inverse();
        CHECK(inverse.rowwise().sum().minCoeff() > 0);
        inverse.diagonal().setConstant(-1);
        CHECK(inverse.maxCoeff() < 0);
    }
}

// Nodes in the middle of cells: a finer grid has stiffer full contact, so the bound is that of the grid.
TEST_CASE("full contact of a map is that of its own grid, and a verdict from it says so", "[areas]") {
    double before = 0;
    for (const Index side : {Index{16}, Index{32}, Index{160}}) {
        const Model model = completed({.grid = {.nodes = side, .length = 1, .rows = side, .width = 1}});
        const double full = stiffness_limits(model).max;
        CHECK(full > before * 1.001);
        before = full;
        const Target stiff{Quantity::stiffness, "", Eigen::Vector2d(1e-5, 1e-4), Eigen::Vector2d(0.9, 9) * full};
        const auto found = out_of_reach({stiff}, model);
        REQUIRE(found.size() == 1);
        CHECK_THAT(found[0].verdict(), Catch::StartsWith("out of reach of every map on this grid: "));
    }
}
