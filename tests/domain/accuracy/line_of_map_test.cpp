#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/line_of_map.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/errors.hpp"
#include "domain/theory/random_surface.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

constexpr Index side = 48;

/// Ridges along y (or x) with `share` of roughness of every direction on them.
Profile ground(double share, bool along_y = true) {
    Grid grid{.nodes = side, .length = 1, .periodic = true};
    const Profile line =
        realised({.longest = 0.5, .shortest = 0.125, .rms_slope = 0.1, .is_area = false}, grid, 3);
    grid.rows = side;
    grid.width = 1;
    Profile map = realised({.longest = 0.5, .shortest = 0.125, .rms_slope = 0.1}, grid, 4);
    map.heights *= share;
    for (Index j = 0; j < side; ++j)
        for (Index i = 0; i < side; ++i)
            map.heights[j * side + i] += line.heights[along_y ? i : j];
    return map;
}

Model periodic() {
    Model model;
    model.grid = {.nodes = side, .length = 1, .periodic = true, .rows = side, .width = 1};
    model.body.kernel = Kernel::periodic;
    model.loading.steps = 6;
    model.loading.reach = 0.6;
    return model;
}

} // namespace

TEST_CASE("the line of a map is the mean across its ridges, and leaves what is on them", "[areas]") {
    for (const bool along_y : {true, false}) {
        const LineOfMap of = line_of_map(ground(0, along_y));
        CHECK(of.along_x == along_y);
        CHECK(of.window.width() < 1e-15);
        CHECK(of.line.nodes() == side);
        CHECK(line_of_map(ground(0.01, along_y)).along_x == along_y);
    }
    CHECK(line_of_map(ground(0.02)).window.width() ==
          Approx(2 * line_of_map(ground(0.01)).window.width()).epsilon(0.2));
    CHECK_THROWS_AS(line_of_map({Eigen::VectorXd::Ones(8), 1}), InputError);
}

TEST_CASE("one line answers for a map only within its bound, which holds", "[areas]") {
    int by_line = 0, by_map = 0;
    for (const double share : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.3}) {
        const Profile map = ground(share);
        const Response exact = respond(map, periodic());
        for (const double accuracy : {1e-3, 1e-2, 0.1}) {
            const AccountedResponse found = respond_within(map, periodic(), accuracy);
            const double error = relative_error(found.response.pressure, exact.pressure);
            INFO(share << ", " << accuracy << ": off by " << error << ", said " << found.account.line_error);
            CHECK(error <= accuracy);
            if (found.account.by_line) {
                ++by_line;
                CHECK(found.account.line_error <= accuracy);
                CHECK(error <= found.account.line_error + 1e-5);
                CHECK(found.account.light_rows == (exact.pressure[0] < 0.01 * exact.pressure[5] ? 1 : 0));
            } else {
                ++by_map;
                CHECK(share > 0);
                CHECK(found.account.line_error > 0);
            }
        }
    }
    CHECK(by_line >= 5);
    CHECK(by_map >= 5);
}

TEST_CASE("a line is asked for loads as well, and never for a free map", "[areas]") {
    Model model = periodic();
    model.loading.pressures = {1e-3, 4e-3};
    const AccountedResponse found = respond_within(ground(0), model, 0.01);
    CHECK(found.account.by_line);
    CHECK(found.response.pressure[1] == Approx(4e-3).epsilon(1e-6));
    Model free = periodic();
    free.grid.periodic = false;
    free.body.kernel = Kernel::free;
    const AccountedResponse of_free = respond_within(ground(0), free, 0.01);
    CHECK_FALSE(of_free.account.by_line);
    CHECK(std::isnan(of_free.account.line_error));
    free.body.hardness = 1;
    CHECK_THROWS_AS(respond_within(ground(0), free, 0.01), InputError);
}
