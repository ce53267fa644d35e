#include "domain/errors.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using testing::random_genome;

namespace {

Model paper_model(Index nodes = 256) { return {{nodes, 0.84942, false}, {}, {}, {}}; }

} // namespace

TEST_CASE("the adjoint derivative of the pressures follows central differences in every gene") {
    std::mt19937_64 random(11);
    for (const bool is_map : {false, true})
        for (Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
            for (const char* end : {"reach", "pressure", "displacement", "shares"}) {
                if (is_map && kernel == Kernel::strip) continue;
                INFO("kernel " << int(kernel) << ", load by " << end << (is_map ? ", map" : ""));
                Model model = paper_model(128);
                model.body.kernel = kernel;
                model.body.strip_width = 0.002;
                model.loading.reach = kernel == Kernel::periodic ? 0.9 : 1;
                if (is_map) {
                    model.grid = {.nodes = 20, .length = 0.84942, .rows = 18, .width = 0.7};
                    model.loading = {4, 0.7};
                }
                model.grid.periodic = kernel == Kernel::periodic;
                const std::size_t ridges = is_map ? 3 : 1 + 7 * (end[0] == 'p');
                const Genome genome = random_genome(random, ridges == 1 ? 2 : 1, ridges, 0.84942,
                                                    is_map ? 0.2 : 8 * model.grid.spacing());
                const Response whole = respond(genome, model);
                if (end == std::string("pressure")) model.loading.to_pressure = 0.3 * whole.pressure.tail(1)[0];
                if (end == std::string("displacement")) model.loading.to_displacement = 0.5 * whole.range;
                if (end == std::string("shares")) model.loading.shares = {0.2, 0.5, 0.55, 0.9, 1};
                const ResponseJacobian jacobian = testing::jacobian_of(genome, model);
                testing::check_derivatives(
                    genome, model,
                    {{jacobian.pressure, [](const Response& response) { return response.pressure; }},
                     {jacobian.last_displacement,
                      [](const Response& response) { return response.displacement.tail(1).eval(); }},
                     {secant_jacobian(respond(genome, model), jacobian).y,
                      [](const Response& response) { return secant_stiffness(response).y; }}});
            }
}

TEST_CASE("load steps reach given pressures, and steps at pressures have no gradient") {
    std::mt19937_64 random(14);
    for (Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Model model = paper_model(512);
        model.body.kernel = kernel;
        model.body.strip_width = 0.002;
        model.grid.periodic = kernel == Kernel::periodic;
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
        model.loading.to_pressure.reset();
        model.loading.pressures = {0.01 * highest, 0.3 * highest, 0.35 * highest};
        model.contact.solver = Solver::nested;
        CHECK(respond(genome, model).pressure.isApprox(highest * Eigen::Vector3d(0.01, 0.3, 0.35), 1e-11));
        CHECK_THROWS_WITH(respond_with_gradient(sample(genome, model.grid), model.body, model.loading),
                          Catch::Contains("gradient"));
    }
}

TEST_CASE("derivatives of pressures with a hardness follow central differences") {
    std::mt19937_64 random(16);
    Model model = paper_model(96);
    const Genome genome = random_genome(random, 1, 1, 0.84942, 0.1);
    const Profile profile = sample(genome, model.grid);
    const double range = displacement_range(profile, model.body.kernel);
    model.body.hardness =
        0.4 * solve_contact(profile, model.body, {range}, {.states = true, .stop = {}}).states[0].pressure.maxCoeff();
    const auto answer = respond_with_gradient(profile, model.body, model.loading);
    CHECK(answer.response.held_nodes > 0);
    const double step = 1e-7 * range;
    for (Index node = 0; node < 96; node += 7) {
        Profile up = profile, down = profile;
        up.heights[node] += step;
        down.heights[node] -= step;
        const Response right = respond(up, model.body, model.loading), left = respond(down, model.body, model.loading);
        if (right.contact_fraction != left.contact_fraction || right.held_nodes != left.held_nodes ||
            right.range != left.range)
            continue;
        const Eigen::VectorXd slope = (right.pressure - left.pressure) / (2 * step);
        // A node that becomes held within the probe bends one row at most.
        const Eigen::ArrayXd off = (slope - answer.gradient.pressure.col(node)).array().abs();
        CHECK((off > 1e-4 * answer.gradient.pressure.cwiseAbs().maxCoeff()).count() <= 1);
    }
    CHECK_THROWS_WITH(scaled(answer.response, 2), Catch::Contains("hardness"));
    CHECK_THROWS_WITH(respond_with_gradient(profile, model.body, model.loading, {}, true), Catch::Contains("hardness"));
}

TEST_CASE("a curve is linear, continued with its end slopes and refused beyond its range") {
    const Curve curve{Eigen::Vector3d(1, 2, 4), Eigen::Vector3d(10, 20, 0), 0, 5};
    CHECK((curve.at(1.5) == Approx(15) && curve.at(3) == Approx(10) && curve.at(5) == Approx(-10)));
    CHECK(curve.at(0) == Approx(0).margin(1e-12));
    for (const double far : {0., 1e6}) // wherever the range is
        for (const double beyond : {-1e-4, 5 + 1e-4})
            CHECK_THROWS_AS((Curve{curve.x.array() + far, curve.y, far, far + 5}.at(far + beyond)), InputError);
}

TEST_CASE("a free map of cells is as large as its lengths and converges with its grid") {
    std::mt19937_64 random(18);
    double of_coarse = 0, of_fine = 0;
    for (int i = 0; i < 3; ++i) {
        const Genome genome = random_genome(random, 2, 3, 0.84942, 0.2);
        Model model{.grid = {.nodes = 24, .length = 0.84942, .rows = 20, .width = 0.7}};
        model.loading = {.pressures = {0.02, 0.1, 0.4}};
        const auto at_scale = [&](Index refine) { return respond(genome, refined(model, refine)); };
        const Response truth = at_scale(9), coarse = at_scale(1), fine = at_scale(3);
        const auto error = [&](const Eigen::VectorXd& of, const Eigen::VectorXd& exact) {
            return ((of - exact).array() / exact.array()).abs().maxCoeff();
        };
        of_coarse += error(coarse.tangent_stiffness, truth.tangent_stiffness);
        of_fine += error(fine.tangent_stiffness, truth.tangent_stiffness);
        CHECK(error(fine.contact_fraction, truth.contact_fraction) <
              0.5 * error(coarse.contact_fraction, truth.contact_fraction));
        // With nodes on the edges of the length, the body of 24 x 20 nodes would be 4 and 5 % too large.
        CHECK(coarse.full_stiffness == Approx(truth.full_stiffness).epsilon(0.02));
        CHECK(model.grid.nominal_area() == Approx(0.84942 * 0.7));
    }
    CHECK(of_fine < 0.2 * of_coarse); // second order: 1/9
}
