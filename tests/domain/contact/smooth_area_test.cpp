#include "domain/contact/interface.hpp"
#include "domain/response/response.hpp"
#include "tests/domain/contact/scenes.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

/// A random profile or map, pressed to `reach` of its height.
scenes::Scene random_scene(std::mt19937_64& random, const Body& body, std::size_t ridges, double shortest, Grid grid,
                           double reach) {
    grid.periodic = body.kernel == Kernel::periodic;
    scenes::Scene scene{sample(testing::random_genome(random, 1, ridges, 0.84942, shortest), grid), body, {}};
    scene.displacements = step_displacements(scene.profile, scene.body, {.reach = reach});
    return scene;
}

scenes::Scene random_line(std::mt19937_64& random, Kernel kernel, Index nodes, double shortest, double reach) {
    return random_scene(random, {.kernel = kernel, .strip_width = 0.002}, 1, shortest, {.nodes = nodes}, reach);
}

scenes::Scene random_area(std::mt19937_64& random, Kernel kernel, double reach) {
    return random_scene(random, {.kernel = kernel}, 3, 0.2, {.nodes = 16, .rows = 14, .width = 0.8}, reach);
}

ContactCurve pressed(const Profile& profile, const Body& body, const std::vector<double>& displacements) {
    return solve_contact(profile, body, displacements, {.states = true});
}

} // namespace

TEST_CASE("a smooth contact fraction is within half a node per edge of the counted one") {
    std::mt19937_64 random(41);
    double mean = 0;
    int steps = 0;
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        for (int scene = 0; scene < 5; ++scene) {
            const auto [profile, body, displacements] = random_line(random, kernel, 256, 0.02, 0.9);
            const auto curve = pressed(profile, body, displacements);
            const SmoothArea area = smooth_area(profile, body, curve);
            for (std::size_t j = 0; j < curve.steps.size(); ++j) {
                const auto& nodes = curve.states[j].nodes;
                int edges = 0;
                for (const int i : nodes)
                    for (const int k : {i - 1, i + 1}) edges += std::find(nodes.begin(), nodes.end(), k) == nodes.end();
                const double off = 256 * (area.fraction[static_cast<Index>(j)] - curve.steps[j].contact_fraction);
                CHECK(std::abs(off) <= 0.5 * edges);
                mean += off / std::max(1, edges);
                ++steps;
            }
        }
    CHECK(std::abs(mean / steps) < 0.05);
}

TEST_CASE("derivatives of a smooth contact fraction agree with differences") {
    std::mt19937_64 random(42);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        for (int scene = 0; scene < 6; ++scene) {
            if (scene >= 3 && kernel == Kernel::strip) break;
            const scenes::Scene pressing =
                scene < 3 ? random_line(random, kernel, 128, 0.05, 0.8) : random_area(random, kernel, 0.8);
            const Profile& profile = pressing.profile;
            const Body& body = pressing.body;
            const std::vector<double>& displacements = pressing.displacements;
            const SmoothArea area = smooth_area(profile, body, pressed(profile, body, displacements));
            Eigen::VectorXd direction(profile.nodes());
            std::normal_distribution<double> normal;
            for (double& each : direction) each = normal(random);
            const double h = 1e-9 * (profile.heights.maxCoeff() - profile.heights.minCoeff());
            const auto moved = [&](double by, bool heights) {
                Profile other = profile;
                std::vector<double> to = displacements;
                if (heights)
                    other.heights += by * direction;
                else
                    for (double& each : to) each += by;
                return pressed(other, body, to);
            };
            for (const bool heights : {true, false}) {
                const ContactCurve above = moved(h, heights), below = moved(-h, heights);
                Profile up = profile, down = profile;
                if (heights) up.heights += h * direction, down.heights -= h * direction;
                const Eigen::VectorXd difference =
                    (smooth_area(up, body, above).fraction - smooth_area(down, body, below).fraction) / (2 * h);
                const Eigen::VectorXd says =
                    heights ? Eigen::VectorXd(area.by_height * direction) : area.by_displacement;
                int kept = 0;
                for (Index j = 0; j < difference.size(); ++j) {
                    const auto& set = above.states[static_cast<std::size_t>(j)].nodes;
                    if (set != below.states[static_cast<std::size_t>(j)].nodes) continue;
                    ++kept;
                    CHECK(difference[j] == Approx(says[j]).epsilon(1e-4).margin(1e-5 * says.cwiseAbs().maxCoeff()));
                }
                CHECK(kept > 10);
            }
        }
}

TEST_CASE("the smooth contact fraction of a map does not jump when a node enters", "[areas]") {
    std::mt19937_64 random(46);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        scenes::Scene scene = random_area(random, kernel, 0.5);
        // From just below to just above the displacement at which a node enters, by bisection.
        const auto count = [&](double displacement) {
            return pressed(scene.profile, scene.body, {displacement}).states[0].nodes.size();
        };
        double below = scene.displacements[8], above = scene.displacements[9];
        REQUIRE(count(below) < count(above));
        const std::size_t lowest = count(below);
        while (above - below > 1e-11 * above) {
            const double middle = 0.5 * (below + above);
            (count(middle) == lowest ? below : above) = middle;
        }
        const auto at = [&](double displacement) {
            return smooth_area(scene.profile, scene.body, pressed(scene.profile, scene.body, {displacement}))
                .fraction[0];
        };
        CHECK(at(above) == Approx(at(below)).margin(0.1 / static_cast<double>(scene.profile.nodes())));
    }
}
