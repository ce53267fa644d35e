#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/response.hpp"
#include "domain/theory/theory.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using testing::random_genome;
using testing::uniform;

namespace {

using testing::paper_length;

struct Scene {
    Body body;
    Grid grid;
    std::vector<double> displacements;
    Profile whole, reduced;
    double dropped_amplitude = 0; ///< sum of R_n G_n of the omitted chromosomes, mm
};

/// A random genome on a random body, and the same genome without some of its chromosomes.
Scene random_scene(std::mt19937_64& random) {
    Scene scene;
    scene.body.kernel = static_cast<Kernel>(std::uniform_int_distribution<int>(0, 2)(random));
    scene.body.strip_width = uniform(random, 0.0005, 0.5);
    scene.body.datum = paper_length * uniform(random, 0.3, 4);
    const bool periodic = scene.body.kernel == Kernel::periodic;
    scene.grid = {std::uniform_int_distribution<Index>(40, 160)(random), paper_length, periodic};
    const Genome genome = random_genome(random, 1 + static_cast<int>(random() % 2), 1 + random() % 3, paper_length,
                                        4 * scene.grid.spacing());
    const double chance = uniform(random, 0.1, 0.6);
    Genome reduced = filtered(
        genome, [&](std::size_t s, std::size_t c) { return (s == 0 && c == 0) || uniform(random, 0, 1) > chance; });
    scene.whole = sample(genome, scene.grid);
    scene.reduced = sample(reduced, scene.grid);
    double all = 0, kept = 0;
    for (const Wave& wave : waves(genome)) all += std::abs(wave.amplitude);
    for (const Wave& wave : waves(reduced)) kept += std::abs(wave.amplitude);
    scene.dropped_amplitude = all - kept;
    scene.displacements = load_displacements(displacement_range(scene.whole, scene.body.kernel),
                                             {10, periodic ? 0.95 : 1}, scene.body.kernel);
    return scene;
}

constexpr Index side = 48;

/// Ridges along y (or x), plus `share` times a roughness without direction.
Profile ground(double share, bool along_y = true) {
    Grid grid{.nodes = side, .length = 1, .periodic = true};
    const Profile line = realised({.longest = 0.5, .shortest = 0.125, .rms_slope = 0.1, .is_2d = false}, grid, 3);
    grid.rows = side;
    grid.width = 1;
    Profile map = realised({.longest = 0.5, .shortest = 0.125, .rms_slope = 0.1}, grid, 4);
    map.heights *= share;
    for (Index j = 0; j < side; ++j)
        for (Index i = 0; i < side; ++i) map.heights[j * side + i] += line.heights[along_y ? i : j];
    return map;
}

Model periodic(double accuracy) {
    return {.grid = {.nodes = side, .length = 1, .periodic = true, .rows = side, .width = 1},
            .body = {Kernel::periodic},
            .loading = {6, 0.6},
            .accuracy = accuracy};
}

} // namespace

TEST_CASE("every kernel falls convexly from node to node, as the bounds need") {
    for (const Index nodes : {2, 3, 8, 9, 64, 257, 1024}) {
        const auto n = static_cast<double>(nodes);
        for (const double datum : {0.26 * n, 1.0 * n, 5.0 * n})
            for (const double width : {0.01, 1.0, 0.5 * n})
                for (const Kernel kernel : {Kernel::free, Kernel::strip}) {
                    const Eigen::VectorXd h = influence_column({kernel, 0, datum, width}, {nodes});
                    for (Index i = 0; i + 1 < nodes; ++i) {
                        CHECK(h[i] > h[i + 1]);
                        CHECK((i == 0 || h[i - 1] - 2 * h[i] + h[i + 1] > 0));
                    }
                }
        // On a circle: convex along every arc that does not pass the loaded node.
        const Eigen::VectorXd h = influence_column({Kernel::periodic}, {nodes});
        for (Index i = 1; i < nodes; ++i) CHECK(h[i - 1] - 2 * h[i] + h[(i + 1) % nodes] > 0);
    }
}

TEST_CASE("the whole profile's pressure is within the reduced profile's shifted curves on every kernel") {
    std::mt19937_64 random(5);
    int steps = 0, informative = 0;
    double tightest = 1;
    for (int trial = 0; trial < 300; ++trial) {
        const Scene scene = random_scene(random);
        const Window window = window_between(scene.whole, scene.reduced);
        CHECK(window.lowest >= -2 * scene.dropped_amplitude);
        CHECK(window.highest <= 2 * scene.dropped_amplitude);
        const Bounds bounds = pressure_bounds(scene.reduced, window, scene.body, scene.displacements);
        const Eigen::VectorXd P =
            response_of(solve_contact(scene.whole, scene.body, scene.displacements).steps, {}, 0).pressure;
        const double rounding = 1e-10 * P.maxCoeff(), first = scene.displacements[0];
        CHECK(pressure_bounds(scene.reduced, {0, first}, scene.body, {first, 2 * first}).lower[0] == 0);
        for (Index j = 0; j < P.size(); ++j, ++steps) {
            INFO("trial " << trial << ", step " << j << ", kernel " << int(scene.body.kernel));
            CHECK(bounds.lower[j] <= P[j] + rounding);
            CHECK(bounds.upper[j] >= P[j] - rounding);
            informative += bounds.lower[j] > 0 && std::isfinite(bounds.upper[j]);
            if (window.width() > 0) tightest = std::min(tightest, (bounds.upper[j] - P[j]) / P.maxCoeff());
        }
    }
    CHECK(informative > steps / 3); // the bounds are not trivial
    CHECK(tightest < 1e-3);         // and are nearly attained
}

TEST_CASE("bounds from one curve are at least as wide as from shifted curves") {
    std::mt19937_64 random(6);
    for (int trial = 0; trial < 200; ++trial) {
        const Scene scene = random_scene(random);
        const Window window = window_between(scene.whole, scene.reduced);
        const Bounds shifted = pressure_bounds(scene.reduced, window, scene.body, scene.displacements);
        auto displacements = scene.displacements;
        const bool periodic = scene.body.kernel == Kernel::periodic;
        const double full = periodic ? displacement_range(scene.reduced, Kernel::periodic) : HUGE_VAL;
        while (!displacements.empty() && displacements.back() > full) displacements.pop_back();
        const auto count = static_cast<Index>(displacements.size());
        if (count == 0) continue;
        if (displacements.back() - window.lowest < full) displacements.push_back(displacements.back() - window.lowest);
        const ContactCurve curve = solve_contact(scene.reduced, scene.body, displacements);
        const Bounds bounds = pressure_bounds(curve.steps, count, window);
        const double rounding = 1e-10 * curve.steps.back().pressure;
        for (Index j = 0; j < count; ++j) {
            CHECK(bounds.lower[j] <= shifted.lower[j] + rounding);
            CHECK(bounds.upper[j] >= shifted.upper[j] - rounding);
        }
    }
}

TEST_CASE("the line of a map is the mean across its ridges, and its window their roughness", "[areas]") {
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

TEST_CASE("one line replaces a map only if its bound, which holds, is within the accuracy", "[areas]") {
    int by_line = 0, by_map = 0;
    for (const double share : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.3}) {
        const Profile map = ground(share);
        const Response exact = respond(map, periodic(0));
        for (const auto& [accuracy, solver] : {std::pair(1e-3, Solver::automatic),
                                               {1e-2, Solver::automatic},
                                               {0.1, Solver::automatic},
                                               {0.1, Solver::polonsky_keer}}) {
            Model model = periodic(accuracy);
            model.contact.solver = solver;
            model.contact.tolerance = 1; // the accuracy sets it
            const ReportedResponse found = respond_within(map, model);
            const double error = relative_error(found.response.pressure, exact.pressure);
            INFO(share << ", " << accuracy << ": error " << error << ", bound " << found.account.line_error);
            CHECK(error <= accuracy);
            if (found.account.by_line) {
                ++by_line;
                CHECK(found.account.line_error <= accuracy);
                CHECK(error <= found.account.line_error + 1e-6);
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

TEST_CASE("a line replaces a periodic map at given pressures too, but no free map", "[areas]") {
    Model model = periodic(0.01);
    model.loading.pressures = {1e-3, 4e-3};
    const ReportedResponse found = respond_within(ground(0), model);
    CHECK(found.account.by_line);
    CHECK(found.response.pressure[1] == Approx(4e-3).epsilon(1e-6));
    Model free = periodic(0.01);
    free.grid.periodic = false;
    free.body.kernel = Kernel::free;
    const ReportedResponse of_free = respond_within(ground(0), free);
    CHECK_FALSE(of_free.account.by_line);
    CHECK(std::isnan(of_free.account.line_error));
    free.body.hardness = 1;
    CHECK_THROWS_AS(respond_within(ground(0), free), InputError);
}
