#include "domain/accuracy/respond.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/response/sensitivity.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using testing::random_genome;

namespace {

Model paper_model(Index nodes = 256) { return {{nodes, 0.84942, false}, {}, {}, {}}; }

ResponseJacobian jacobian_of(const Genome& genome, const Model& model) {
    return in_genes(
        respond_with_gradient(sample(genome, model.grid), model.body, model.loading, model.contact).gradient,
        [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); });
}

std::vector<double> contact_counts(const Response& response) {
    return {response.contact_fraction.begin(), response.contact_fraction.end()};
}

std::pair<Index, Index> extremes(const Profile& profile) {
    Index highest, lowest;
    profile.heights.maxCoeff(&highest);
    profile.heights.minCoeff(&lowest);
    return {highest, lowest};
}

} // namespace

TEST_CASE("the adjoint derivative of the pressures follows central differences in every gene") {
    std::mt19937_64 random(11);
    int probes = 0, kept = 0;
    for (Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        for (const char* end : {"reach", "pressure", "displacement"})
            for (std::size_t ridges : {1u, 8u}) {
                const int series = ridges == 1 ? 2 : 1;
                Model model = paper_model(128);
                model.body.kernel = kernel;
                model.body.strip_width = 0.002;
                model.grid.wraps = kernel == Kernel::periodic;
                model.loading.reach = kernel == Kernel::periodic ? 0.9 : 1;
                const Genome genome =
                    random_genome(random, series, ridges, 0.84942, 8 * model.grid.spacing());
                const Response whole = respond(genome, model);
                if (end == std::string("pressure"))
                    model.loading.to_pressure = 0.3 * whole.pressure.tail(1)[0];
                if (end == std::string("displacement"))
                    model.loading.to_displacement = 0.5 * whole.range;
                const ResponseJacobian jacobian = jacobian_of(genome, model);
                const auto values = genes(genome);
                const Response base = respond(genome, model);
                const auto base_extremes = extremes(sample(genome, model.grid));
                const double largest = jacobian.pressure.cwiseAbs().maxCoeff();
                for (std::size_t g = 0; g < values.size(); ++g, ++probes) {
                    const double h = 1e-5;
                    auto up = values, down = values;
                    up[g] += h;
                    down[g] -= h;
                    const Genome above = with_genes(genome, up), below = with_genes(genome, down);
                    const Response right = respond(above, model), left = respond(below, model);
                    // A probe across a change of the contact set or of an extreme node has no derivative to
                    // follow.
                    if (contact_counts(right) != contact_counts(base) ||
                        contact_counts(left) != contact_counts(base) ||
                        extremes(sample(above, model.grid)) != base_extremes ||
                        extremes(sample(below, model.grid)) != base_extremes)
                        continue;
                    ++kept;
                    const Eigen::VectorXd difference = (right.pressure - left.pressure) / (2 * h);
                    INFO("kernel " << int(kernel) << ", load by " << end << ", gene " << g);
                    CHECK((difference - jacobian.pressure.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() <
                          1e-5 * largest);
                    const Index last = base.steps() - 1;
                    CHECK(std::abs((right.displacement[last] - left.displacement[last]) / (2 * h) -
                                   jacobian.last_displacement[static_cast<Index>(g)]) <=
                          1e-5 * jacobian.last_displacement.cwiseAbs().maxCoeff());
                }
            }
    CHECK(kept > probes / 2);
}

TEST_CASE("load steps to a pressure end at that pressure") {
    std::mt19937_64 random(14);
    for (Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Model model = paper_model(512);
        model.body.kernel = kernel;
        model.body.strip_width = 0.002;
        model.grid.wraps = kernel == Kernel::periodic;
        model.loading.reach = kernel == Kernel::periodic ? 0.9 : 1;
        const Genome genome = random_genome(random, 1, 1, 0.84942, 0.02);
        const double highest = respond(genome, model).pressure.tail(1)[0];
        for (double part : {1e-3, 0.1, 0.9}) {
            model.loading.to_pressure = part * highest;
            model.contact.solver = Solver::nested;
            CHECK(respond(genome, model).pressure.tail(1)[0] == Approx(part * highest).epsilon(1e-11));
            model.contact.solver = Solver::active_set;
            const double above = respond(genome, model).pressure.tail(1)[0] / (part * highest) - 1;
            CHECK(above >= 0);
            CHECK(above <= 3e-6);
        }
        if (kernel == Kernel::periodic) {
            model.loading.to_pressure = 100 * highest;
            CHECK_THROWS_WITH(respond(genome, model), Catch::Contains("full contact"));
        }
    }
}

TEST_CASE("load steps at given pressures bear these pressures, and have no gradient") {
    std::mt19937_64 random(15);
    for (Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Model model = paper_model(256);
        model.body.kernel = kernel;
        model.body.strip_width = 0.002;
        model.grid.wraps = kernel == Kernel::periodic;
        model.loading.reach = 0.9;
        const Genome genome = random_genome(random, 1, 1, 0.84942, 0.02);
        const double highest = respond(genome, model).pressure.tail(1)[0];
        model.loading.pressures = {0.01 * highest, 0.3 * highest, 0.35 * highest};
        model.contact.solver = Solver::nested;
        const Response response = respond(genome, model);
        REQUIRE(response.steps() == 3);
        for (Index j = 0; j < 3; ++j)
            CHECK(response.pressure[j] ==
                  Approx(model.loading.pressures[static_cast<std::size_t>(j)]).epsilon(1e-11));
        const Profile profile = sample(genome, model.grid);
        CHECK_THROWS_WITH(respond_with_gradient(profile, model.body, model.loading),
                          Catch::Contains("gradient"));
        std::swap(model.loading.pressures[0], model.loading.pressures[1]);
        CHECK_THROWS_WITH(respond(genome, model), Catch::Contains("increasing"));
    }
}

TEST_CASE("a map's load steps at given pressures are those at the displacements that bear them", "[areas]") {
    const Profile map = maps::self_affine(32, 0.8, 3, 0.05);
    const Body body{Kernel::periodic, 1e4};
    const double highest = respond(map, body, {.steps = 4}).pressure[3];
    const Loading loads{.pressures = {0.1 * highest, 0.5 * highest}};
    const std::vector<double> displacements = step_displacements(map, body, loads, {});
    const ContactCurve curve = solve_contact(map, body, displacements);
    const Response response = respond(map, body, loads);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(curve.steps[j].pressure == Approx(loads.pressures[j]).epsilon(3e-6));
        CHECK(response.displacement[static_cast<Index>(j)] == displacements[j]);
        CHECK(response.pressure[static_cast<Index>(j)] == Approx(loads.pressures[j]).epsilon(3e-6));
    }
}

TEST_CASE("with a hardness the derivative of the pressures is that of the elastic nodes alone") {
    std::mt19937_64 random(16);
    Model model = paper_model(96);
    const Genome genome = random_genome(random, 1, 1, 0.84942, 0.1);
    ContactOptions options;
    options.states = true;
    const Profile profile = sample(genome, model.grid);
    const double range = displacement_range(profile, model.body.kernel);
    model.body.hardness =
        0.4 * solve_contact(profile, model.body, {range}, options).states[0].pressure.maxCoeff();
    const auto answer = respond_with_gradient(profile, model.body, model.loading);
    CHECK(answer.response.held_nodes > 0);
    const double step = 1e-7 * range;
    for (Index node = 0; node < 96; node += 7) {
        Profile up = profile, down = profile;
        up.heights[node] += step;
        down.heights[node] -= step;
        const Response right = respond(up, model.body, model.loading),
                       left = respond(down, model.body, model.loading);
        if (right.contact_fraction != left.contact_fraction || right.held_nodes != left.held_nodes ||
            right.range != left.range)
            continue;
        const Eigen::VectorXd slope = (right.pressure - left.pressure) / (2 * step);
        // A node that becomes held within the probe bends one row at most.
        const Eigen::ArrayXd off = (slope - answer.gradient.pressure.col(node)).array().abs();
        CHECK((off > 1e-4 * answer.gradient.pressure.cwiseAbs().maxCoeff()).count() <= 1);
    }
    CHECK_THROWS_WITH(scaled(answer.response, 2), Catch::Contains("hardness"));
    CHECK_THROWS_WITH(respond_with_gradient(profile, model.body, model.loading, {}, true),
                      Catch::Contains("hardness"));
}

TEST_CASE("a scaled profile has scaled pressures and the same stiffness and contact") {
    std::mt19937_64 random(12);
    for (int i = 0; i < 10; ++i) {
        Genome genome = random_genome(random, 1, 1, 0.84942, 0.02);
        const Response one = respond(genome, paper_model());
        genome.scale = 37;
        const Response many = respond(genome, paper_model());
        CHECK((many.pressure - 37 * one.pressure).norm() < 1e-10 * many.pressure.norm());
        CHECK((many.tangent_stiffness - one.tangent_stiffness).norm() < 1e-10 * one.tangent_stiffness.norm());
        CHECK(many.contact_fraction == one.contact_fraction);
        CHECK((scaled(one, 37).displacement - many.displacement).norm() < 1e-12 * many.displacement.norm());
    }
}

TEST_CASE("secants lie between the tangents at the ends of their step") {
    std::mt19937_64 random(13);
    for (int i = 0; i < 10; ++i) {
        const Response response = respond(random_genome(random, 1, 1, 0.84942, 0.02), paper_model());
        const Curve K = secant_stiffness(response);
        for (Index j = 1; j < response.steps(); ++j) {
            CHECK(K.y[j] >= response.tangent_stiffness[j - 1] * (1 - 1e-9));
            CHECK(K.y[j] <= response.tangent_stiffness[j] * (1 + 1e-9));
        }
    }
}

TEST_CASE(
    "a curve is linear between its points, continued with its end slopes, and refused beyond its range") {
    const Curve curve{Eigen::Vector3d(1, 2, 4), Eigen::Vector3d(10, 20, 0), 0, 5};
    CHECK(curve.at(1.5) == Approx(15));
    CHECK(curve.at(3) == Approx(10));
    CHECK(curve.at(0) == Approx(0).margin(1e-12));
    CHECK(curve.at(5) == Approx(-10));
    CHECK(curve.held_at(4.5) == Approx(0).margin(1e-12));
    CHECK_THROWS_AS(curve.at(5.1), InputError);
    CHECK_THROWS_AS(curve.at(-0.1), InputError);
}

TEST_CASE("a curve taken to its end reads the same everywhere") {
    std::mt19937_64 random(5);
    const Response response = respond(random_genome(random, 1, 1, 0.84942, 0.02), paper_model());
    for (const Curve& curve : {secant_stiffness(response), area_against_pressure(response)}) {
        const Curve whole = to_its_end(curve);
        CHECK(whole.x.tail(1)[0] == curve.to);
        for (int k = 0; k <= 50; ++k)
            CHECK(whole.at(curve.to * k / 50) == Approx(curve.at(curve.to * k / 50)).epsilon(1e-12));
    }
}

TEST_CASE("a profile without a height range and load steps without sense are refused") {
    const Profile flat{Eigen::VectorXd::Constant(16, 0.3), 0.1};
    CHECK_THROWS_WITH(respond(flat, {}, {}), Catch::Contains("all heights are equal"));
    CHECK_THROWS_WITH(displacement_range({Eigen::VectorXd::Constant(1, 0.3), 0.1}, Kernel::free),
                      Catch::Contains("at least 2"));
    CHECK_THROWS_WITH(load_displacements(1, {1, 1}, Kernel::free), Catch::Contains("steps: 1"));
    CHECK_THROWS_WITH(load_displacements(1, {20, 1}, Kernel::periodic), Catch::Contains("less than 1"));
    CHECK_THROWS_WITH(load_displacements(1, {20, 1.5}, Kernel::free), Catch::Contains("reach"));
}
