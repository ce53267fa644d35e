#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/extrapolation.hpp"
#include "domain/accuracy/load_rows.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/errors.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using testing::random_genome;

namespace {

constexpr double length = 0.84942;

Model model_on(Kernel kernel, const Genome& genome) {
    Model model;
    model.body.kernel = kernel;
    model.body.strip_width = length / 511;
    model.loading.reach = kernel == Kernel::periodic ? 0.95 : 1;
    model.grid = resolved_grid(genome, length, kernel == Kernel::periodic);
    return model;
}

/// One wave of the profile's length, at a twentieth of its height.
Genome smooth_scene() { return {1, {{1, 1, 1.5, length, {{1, {0.3}}}}}}; }

} // namespace

TEST_CASE(
    "relative errors are those of pressure and secant, and under 1 % of the last pressure relative to it") {
    Eigen::VectorXd resolved(4), found(4);
    resolved << 0.001, 1, 4, 9;
    found << 0.002, 1, 4, 9;
    // Row 1 is light: 0.001 against 0.09. Row 2's secant is off by 0.001 of 0.999.
    CHECK(relative_error(found, resolved) == Approx(0.001 / 0.09));
    found << 0.001, 1, 4, 9.9;
    CHECK(relative_error(found, resolved) == Approx(0.9 / 5)); // the secant is hit harder than the pressure
    CHECK(relative_error(resolved, resolved) == 0);
}

TEST_CASE("a bound divides by the exact pressure, which may be less than the curve's") {
    const Eigen::Vector2d pressure(1, 2), lower(0.9, 1.9), upper(1, 2.1);
    const Eigen::VectorXd bound = relative(doubt_of(pressure, lower, upper), error_scale(pressure));
    const Eigen::Vector2d exact(0.9, 1.9);
    CHECK(bound[0] >= relative_error(pressure, exact) * (1 - 1e-12));
    CHECK(bound[0] == Approx(0.1 / 0.9));
    CHECK(std::isinf(relative(doubt_of(pressure, lower - pressure, upper), error_scale(pressure))[0]));
}

TEST_CASE("the extrapolation finds a line's end exactly and doubts scattered values") {
    const std::vector<Index> grids{400, 576, 810, 1152};
    Eigen::VectorXd end(3), slope(3);
    end << 1, 2.5, 5;
    slope << 30, -20, 50;
    Eigen::MatrixXd values(3, 4);
    for (Index i = 0; i < 4; ++i)
        values.col(i) =
            end + slope * (std::pow(grids[static_cast<std::size_t>(i)], -1.5) - std::pow(4097, -1.5));
    const Extrapolation clean = extrapolate(grids, values, 4097);
    CHECK((clean.pressure - end).cwiseAbs().maxCoeff() < 1e-12);
    values(1, 1) += 0.01;
    values(1, 2) -= 0.01;
    CHECK(extrapolate(grids, values, 4097).doubt.pressure[1] > clean.doubt.pressure[1]);
    CHECK(extrapolate(grids, values, 4097).doubt.pressure[0] == Approx(clean.doubt.pressure[0]));
    CHECK((extrapolate(grids, values, 4097).pressure - end).cwiseAbs().maxCoeff() > 1e-4);
}

TEST_CASE("rows read between solved ones stay within their bound, on every kernel") {
    std::mt19937_64 random(21);
    int spared = 0;
    for (int trial = 0; trial < 12; ++trial) {
        const auto kernel = static_cast<Kernel>(trial % 3);
        const Grid grid{200, length, kernel == Kernel::periodic};
        const Profile profile = sample(random_genome(random, 1, 1, length, 12 * grid.spacing()), grid);
        Body body;
        body.kernel = kernel;
        body.strip_width = length / 511;
        const auto displacements =
            load_displacements(displacement_range(profile, kernel), {1500, 0.9}, kernel);
        for (const double accuracy : {0.05, 0.005}) {
            const LoadRows exact = solve_rows(profile, body, displacements, {});
            const LoadRows read = solve_rows(profile, body, displacements, {}, accuracy);
            Eigen::VectorXd P(1500), R(1500);
            for (Index j = 0; j < 1500; ++j) {
                P[j] = read.steps[static_cast<std::size_t>(j)].pressure;
                R[j] = exact.steps[static_cast<std::size_t>(j)].pressure;
            }
            INFO("trial " << trial << ", accuracy " << accuracy << ", solved " << read.solved);
            CHECK(exact.solved == 1500);
            CHECK(exact.error == 0);
            CHECK(read.error <= accuracy);
            CHECK(relative_error(P, R) <= read.error * 1.2 + 1e-9);
            spared += 1500 - read.solved;
        }
    }
    CHECK(spared > 12 * 1500 / 2);
}

TEST_CASE("a response within an accuracy is that near the resolved one, and says so") {
    std::mt19937_64 random(22);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        for (int trial = 0; trial < 3; ++trial) {
            const Genome genome = random_genome(random, 1, 1, length, length / 16);
            Model model = model_on(kernel, genome);
            model.grid.nodes = kernel == Kernel::periodic ? 1024 : 1025;
            const AccountedResponse exact = respond_exactly(genome, model);
            for (const double accuracy : {3e-2, 1e-2}) {
                const AccountedResponse cheap = respond_within(genome, model, accuracy);
                INFO("kernel " << int(kernel) << ", trial " << trial << ", accuracy " << accuracy);
                CHECK(relative_error(cheap.response.pressure, exact.response.pressure) <= accuracy);
                CHECK(cheap.account.estimated_error <= accuracy);
                CHECK(cheap.response.displacement == exact.response.displacement);
            }
        }
}

TEST_CASE("an exact account is the model's own response and claims no error") {
    std::mt19937_64 random(23);
    const Genome genome = random_genome(random, 2, 1, length, length / 20);
    Model model;
    model.grid.nodes = 300;
    const AccountedResponse exact = respond_exactly(genome, model);
    CHECK(exact.response.pressure == respond(genome, model).pressure);
    CHECK(exact.account.estimated_error < 1e-8);
    CHECK(exact.account.grids == std::vector<Index>{300});
    CHECK(exact.account.dropped.empty());
}

TEST_CASE("a smooth wave needs few nodes, and its many tiny companions are left out with their bound") {
    Genome genome = smooth_scene();
    const AccountedResponse smooth = respond_within(genome, model_on(Kernel::free, genome), 1e-2);
    CHECK(smooth.account.extrapolated());
    CHECK(smooth.account.grids.back() <= 512);
    for (int n = 2; n <= 12; ++n)
        genome.series[0].chromosomes.push_back({n, {0.1 * n}});
    genome.series[0].H = 3; // falls off so fast that the short waves are next to nothing
    Model model = model_on(Kernel::free, genome);
    const AccountedResponse cheap = respond_within(genome, model, 1e-2);
    const AccountedResponse exact = respond_exactly(genome, model);
    CHECK_FALSE(cheap.account.dropped.empty());
    CHECK(cheap.account.dropped.size() + cheap.account.used.size() == 12);
    CHECK(cheap.account.dropped_error > 0);
    CHECK(relative_error(cheap.response.pressure, exact.response.pressure) <= 1e-2);
}

TEST_CASE("where no coarser grid will do, the resolved model is solved itself") {
    std::mt19937_64 random(24);
    const Genome genome = random_genome(random, 1, 1, length, length / 511);
    Model model;
    model.grid.nodes = 512; // waves down to the spacing
    const AccountedResponse cheap = respond_within(genome, model, 1e-4);
    CHECK_FALSE(cheap.account.extrapolated());
    CHECK(cheap.account.grids.back() == 512);
    CHECK(relative_error(cheap.response.pressure, respond(genome, model).pressure) < 1e-9);
}
