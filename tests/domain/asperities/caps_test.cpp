#include "domain/asperities/caps.hpp"
#include "ga/base/random.hpp"
#include "tests/catch.hpp"

#include <numbers>

using namespace rough;

namespace {

constexpr double modulus = 1.36, radius = 0.526;

Caps random_caps(const CapArray& array, std::uint64_t seed) {
    ga::Stream random(seed);
    Caps caps{array, Eigen::VectorXd(array.caps()), Eigen::VectorXd(array.caps())};
    for (double& height : caps.heights) height = random.uniform(0, 0.12);
    for (double& each : caps.radii) each = random.uniform(0.1, 0.53);
    return caps;
}

} // namespace

TEST_CASE("one cap has the contact of Hertz under both models") {
    const Caps caps{{1, 1, 1.5}, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, radius)};
    for (const CapModel model : {CapModel::independent, CapModel::interacting})
        for (const double depth : {1e-6, 1e-3, 0.03, 0.12}) {
            const CapContact contact(caps.array, modulus, model);
            const double force = 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(depth, 1.5);
            const CapState pressed = contact.at_load(caps, force);
            CHECK(-pressed.plane == Approx(depth).epsilon(1e-12));
            CHECK(pressed.total_area() == Approx(std::numbers::pi * radius * depth).epsilon(1e-12));
            CHECK(pressed.stiffness == Approx(2 * modulus * std::sqrt(radius * depth)).epsilon(1e-12));
            CHECK(contact.at_plane(caps, -depth).load() == Approx(force).epsilon(1e-12));
        }
}

TEST_CASE("pressed caps satisfy their equations and carry the load") {
    const CapArray array{5, 4, 1.5};
    const Caps caps = random_caps(array, 3);
    const CapState pressed = CapContact(array, modulus, CapModel::interacting).at_load(caps, 0.5);
    CHECK(pressed.load() == Approx(0.5).epsilon(1e-12));
    for (Index i = 0; i < array.caps(); ++i) {
        double depth = caps.heights[i] - pressed.plane;
        for (Index j = 0; j < array.caps(); ++j)
            if (j != i)
                depth -= pressed.force[j] /
                         (std::numbers::pi * modulus * std::hypot(array.x(i) - array.x(j), array.y(i) - array.y(j)));
        CHECK(pressed.indentation[i] == Approx(depth).margin(1e-13));
        CHECK((pressed.force[i] > 0) == (depth > 0));
    }
}

TEST_CASE("a thousand caps are pressed by a load that many of them share") {
    const CapArray array{40, 25, 1.5};
    Caps caps = random_caps(array, 4);
    caps.radii.setConstant(radius);
    const CapState pressed = CapContact(array, modulus, CapModel::interacting).at_load(caps, 15);
    CHECK(pressed.load() == Approx(15).epsilon(1e-10));
    CHECK((pressed.force.array() > 0).count() > 500);
}

TEST_CASE("derivatives of pressed caps equal differences") {
    const CapArray array{4, 4, 1.5};
    for (const CapModel model : {CapModel::independent, CapModel::interacting})
        for (const std::uint64_t seed : {1, 2, 3}) {
            const Caps caps = random_caps(array, seed);
            const CapContact contact(array, modulus, model);
            const double plane = 0.03;
            const CapState pressed = contact.at_plane(caps, plane);
            const CapSlopes slopes = contact.slopes(caps, pressed);
            const auto values = [&](const Caps& moved) {
                const CapState at = contact.at_plane(moved, plane);
                return Eigen::Vector3d(at.load(), at.total_area(), at.stiffness);
            };
            for (const auto& [member, by] :
                 {std::pair(&Caps::heights, &CapSlope::by_heights), {&Caps::radii, &CapSlope::by_radii}})
                for (Index i = 0; i < array.caps(); ++i) {
                    if (std::abs(pressed.indentation[i]) < 1e-3) // it touches or leaves in between
                        continue;
                    Caps up = caps, down = caps;
                    const double h = 1e-6;
                    (up.*member)[i] += h, (down.*member)[i] -= h;
                    const Eigen::Vector3d difference = (values(up) - values(down)) / (2 * h);
                    const CapSlope* const all[] = {&slopes.load, &slopes.area, &slopes.stiffness};
                    for (int q = 0; q < 3; ++q)
                        CHECK(std::abs(difference[q] - (all[q]->*by)[i]) <= 1e-6 * (all[q]->*by).cwiseAbs().maxCoeff());
                }
        }
}

TEST_CASE("interacting caps agree with boundary elements") {
    for (const CapArray& array : {CapArray{2, 1, 1.5}, CapArray{4, 4, 1.5}}) {
        Caps caps = random_caps(array, 16);
        caps.radii.setConstant(radius);
        const double highest = caps.heights.maxCoeff();
        // 40,000 nodes per cap: radii of spots of 17 nodes and more
        const auto meshed =
            pressed_on_mesh(caps, modulus, {0.06, 0.12}, false, 40000 * static_cast<double>(array.caps()));
        for (const MeshedCaps& mesh : meshed) {
            const CapState pressed =
                CapContact(array, modulus, CapModel::interacting).at_plane(caps, highest - mesh.approach);
            INFO(array.caps() << " caps at " << mesh.approach << " mm");
            CHECK(pressed.load() == Approx(mesh.load).epsilon(0.005));
            CHECK(mesh.force.sum() == Approx(mesh.load).epsilon(1e-12));
            CHECK(pressed.total_area() == Approx(mesh.area.sum()).epsilon(0.005));
            CHECK(pressed.stiffness == Approx(mesh.stiffness).epsilon(0.05));
            for (Index i = 0; i < array.caps(); ++i) {
                CHECK(mesh.area_low[i] <= mesh.area[i]);
                CHECK(mesh.area[i] <= mesh.area_high[i]);
                CHECK(std::abs(pressed.force[i] - mesh.force[i]) <= 0.005 * mesh.force.maxCoeff());
            }
        }
    }
}
