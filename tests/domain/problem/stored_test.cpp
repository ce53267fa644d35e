#include "domain/problem/stored.hpp"
#include "tests/catch.hpp"

using namespace rough;
using nlohmann::json;

TEST_CASE("a stored set-up is read back to the bit, and unset values stay unset") {
    DesignSetup setup;
    setup.model.grid = {257, 1. / 3, true, 0.1, 5, 0.7};
    setup.model.body = {Kernel::strip, 2. / 3, 0.3, 0.4, std::numeric_limits<double>::infinity()};
    setup.model.loading = {7, 0.9, 1e-5, 1e-3, {1e-6, 2e-6}};
    setup.model.contact = {Solver::active_set, 1e-7, true, 1e9, {}};
    setup.bounds = {0.1, 0.2, 1.3, 1.4, 0.5, 0.6};
    setup.limits = {0.01, 0.02, 0.03, 0.04};
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(3, 0.1, 1. / 7);
    setup.targets = {{Quantity::interface_stiffness, "t.csv", x, x, x, x, 0.3, {{"kernel", "strip"}}}, {}};
    const auto stored = [&] { return json::from_cbor(json::to_cbor(json(setup))).get<DesignSetup>(); };
    const DesignSetup back = stored();
    CHECK(json(back) == json(setup));
    CHECK_FALSE((back.max_pressure || back.threshold || back.phases || back.measured));
    CHECK(back.targets[0].x == x);
    CHECK_FALSE(back.model.body.yields());

    setup.max_pressure = 0;
    setup.threshold = 1e-5;
    setup.phases = PhaseReach{0.2, 0.3};
    setup.measured = Profile{Eigen::VectorXd::LinSpaced(6, -1, 1), 0.1, 2, 0.2};
    const DesignSetup full = stored();
    CHECK(json(full) == json(setup));
    CHECK(full.max_pressure == 0.);
    CHECK(full.measured->heights == setup.measured->heights);
}

TEST_CASE("a set-up's description depends on every number that affects a result, not on file names") {
    DesignSetup setup;
    setup.targets = {Target{}}, setup.phases = PhaseReach(), setup.measured = Profile();
    setup.max_pressure = setup.threshold = setup.model.body.hardness = 1;
    setup.limits = {1, 1, 1, 1};
    DesignSetup other = setup;
    other.targets[0].name = "elsewhere/target.csv";
    CHECK(description(other) == description(setup));
    // A new member does not compile before it has a name here.
    auto& [model, targets, max_pressure, threshold, bounds, phases, limits, measured, similarity, ridges, smooth_area,
           errors] = other;
    auto& [grid, body, loading, contact, accuracy] = model;
    auto& [nodes, length, periodic, from, rows, width, from_y] = grid;
    auto& [kernel, modulus, datum, strip_width, hardness, layering] = body;
    auto& [steps, reach, to_pressure, to_displacement, pressures, shares] = loading;
    const auto may_affect = [&](auto& number) {
        const auto before = std::exchange(number, number.value_or(0) + 1);
        CHECK(description(other) != description(setup));
        number = before;
    };
    may_affect(datum), may_affect(strip_width), may_affect(reach), may_affect(to_pressure), may_affect(to_displacement);
    auto& [solver, tolerance, states, memory_limit, threads, stop, spots] = contact;
    auto& [H_from, H_to, gamma_from, gamma_to, lambda_from, lambda_to] = bounds;
    auto& [relative, absolute] = *phases;
    auto& [shortest_wave, slope, height, radius] = limits;
    auto& [noise, noise_length, tilt] = errors;
    const auto affects = [&](auto& number) {
        const auto before = std::exchange(number, number + 1);
        CHECK(description(other) != description(setup));
        number = before;
    };
    const auto each_affects = [&](auto&... numbers) { (affects(numbers), ...); };
    each_affects(accuracy, length, from, width, from_y, modulus, hardness, tolerance, memory_limit, H_from, H_to,
                 gamma_from, gamma_to, lambda_from, lambda_to, relative, absolute, shortest_wave, slope, height, radius,
                 noise, noise_length, tilt, similarity, *max_pressure, *threshold, targets[0].weight, measured->spacing,
                 nodes, rows, steps, ridges, layering.poissons_ratio);
    smooth_area = true;
    CHECK(description(other) != description(setup));
    smooth_area = false;
    other.model.body.kernel = Kernel::periodic;
    CHECK(description(other) != description(setup));
}
