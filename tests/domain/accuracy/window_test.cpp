#include "domain/accuracy/window.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/mwm/sampling.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using testing::random_genome;
using testing::uniform;

namespace {

constexpr double length = 0.84942;

struct Scene {
    Body body;
    Grid grid;
    std::vector<double> displacements;
    Profile whole, reduced;
    double dropped_amplitude = 0; ///< sum of R_n G_n of the chromosomes left out, mm
};

/// A random genome on a random body, and the same genome without some of its chromosomes.
Scene random_scene(std::mt19937_64& random) {
    Scene scene;
    scene.body.kernel = static_cast<Kernel>(std::uniform_int_distribution<int>(0, 2)(random));
    scene.body.strip_width = uniform(random, 0.0005, 0.5);
    scene.body.datum = length * uniform(random, 0.3, 4);
    const bool periodic = scene.body.kernel == Kernel::periodic;
    scene.grid = {std::uniform_int_distribution<Index>(40, 160)(random), length, periodic};
    const Genome genome = random_genome(random, 1 + static_cast<int>(random() % 2), 1 + random() % 3, length,
                                        4 * scene.grid.spacing());
    const double chance = uniform(random, 0.1, 0.6);
    Genome reduced = filtered(genome, [&](std::size_t s, std::size_t c) {
        return (s == 0 && c == 0) || uniform(random, 0, 1) > chance;
    });
    scene.whole = sample(genome, scene.grid);
    scene.reduced = sample(reduced, scene.grid);
    double all = 0, kept = 0;
    for (const Wave& wave : waves(genome))
        all += std::abs(wave.amplitude);
    for (const Wave& wave : waves(reduced))
        kept += std::abs(wave.amplitude);
    scene.dropped_amplitude = all - kept;
    scene.displacements = load_displacements(displacement_range(scene.whole, scene.body.kernel),
                                             {10, periodic ? 0.95 : 1}, scene.body.kernel);
    return scene;
}

Eigen::VectorXd pressures(const ContactCurve& curve) {
    Eigen::VectorXd result(static_cast<Index>(curve.steps.size()));
    for (Index j = 0; j < result.size(); ++j)
        result[j] = curve.steps[static_cast<std::size_t>(j)].pressure;
    return result;
}

} // namespace

TEST_CASE("every kernel falls off convexly from node to node, which the bounds rest on") {
    for (const Index nodes : {2, 3, 8, 9, 64, 257, 1024}) {
        const auto n = static_cast<double>(nodes);
        for (const double datum : {0.26 * n, 1.0 * n, 5.0 * n})
            for (const double width : {0.01, 1.0, 0.5 * n}) {
                for (const Kernel kernel : {Kernel::free, Kernel::strip}) {
                    const Eigen::VectorXd h = influence_column({kernel, 0, datum, width}, {nodes});
                    for (Index i = 0; i + 1 < nodes; ++i)
                        CHECK(h[i] > h[i + 1]);
                    for (Index i = 1; i + 1 < nodes; ++i)
                        CHECK(h[i - 1] - 2 * h[i] + h[i + 1] > 0);
                }
            }
        // On a circle: convex along every arc that does not pass the loaded node.
        const Eigen::VectorXd h = influence_column({Kernel::periodic}, {nodes});
        for (Index i = 1; i < nodes; ++i)
            CHECK(h[i - 1] - 2 * h[i] + h[(i + 1) % nodes] > 0);
    }
}

TEST_CASE("the whole profile's pressure stays within the reduced profile's shifted curves, on every kernel") {
    std::mt19937_64 random(5);
    int steps = 0, informative = 0;
    double tightest = 1;
    for (int trial = 0; trial < 300; ++trial) {
        const Scene scene = random_scene(random);
        const Window window = window_between(scene.whole, scene.reduced);
        CHECK(window.lowest >= -2 * scene.dropped_amplitude);
        CHECK(window.highest <= 2 * scene.dropped_amplitude);
        const Bounds bounds = pressure_bounds(scene.reduced, window, scene.body, scene.displacements);
        const Eigen::VectorXd P = pressures(solve_contact(scene.whole, scene.body, scene.displacements));
        const double rounding = 1e-10 * P.maxCoeff();
        for (Index j = 0; j < P.size(); ++j, ++steps) {
            INFO("trial " << trial << ", step " << j << ", kernel " << int(scene.body.kernel));
            CHECK(bounds.lower[j] <= P[j] + rounding);
            CHECK(bounds.upper[j] >= P[j] - rounding);
            informative += bounds.lower[j] > 0 && std::isfinite(bounds.upper[j]);
            if (window.width() > 0)
                tightest = std::min(tightest, (bounds.upper[j] - P[j]) / P.maxCoeff());
        }
    }
    CHECK(informative > steps / 3); // the bounds are not empty words
    CHECK(tightest < 1e-3);         // and are nearly attained
}

TEST_CASE("bounds from one curve and its tangents hold, and are no tighter than those from shifted curves") {
    std::mt19937_64 random(6);
    for (int trial = 0; trial < 200; ++trial) {
        const Scene scene = random_scene(random);
        const Window window = window_between(scene.whole, scene.reduced);
        const Bounds shifted = pressure_bounds(scene.reduced, window, scene.body, scene.displacements);
        auto displacements = scene.displacements;
        double full = std::numeric_limits<double>::infinity();
        if (scene.body.kernel == Kernel::periodic)
            full = displacement_range(scene.reduced, Kernel::periodic);
        while (!displacements.empty() && displacements.back() > full)
            displacements.pop_back();
        const auto count = static_cast<Index>(displacements.size());
        if (count == 0)
            continue;
        if (displacements.back() - window.lowest < full)
            displacements.push_back(displacements.back() - window.lowest);
        const ContactCurve curve = solve_contact(scene.reduced, scene.body, displacements);
        const Bounds bounds = pressure_bounds(curve.steps, count, window);
        const double rounding = 1e-10 * curve.steps.back().pressure;
        for (Index j = 0; j < count; ++j) {
            CHECK(bounds.lower[j] <= shifted.lower[j] + rounding);
            CHECK(bounds.upper[j] >= shifted.upper[j] - rounding);
        }
    }
}
