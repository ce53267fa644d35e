#pragma once

#include "domain/mwm/test_surfaces.hpp"
#include "domain/problem/problem.hpp"
#include "tests/domain/random_genome.hpp"

/// Twenty targets of stiffness: what unseen surfaces of several kinds answer, and formulas.
namespace suite {

using rough::Index;
using rough::Target;

struct Asked {
    Target target;
    bool attainable;
};

inline const rough::Grid grid{512, 0.84942, false};

/// K at twenty even pressures up to the profile's full approach, as a measured curve would give it.
inline Target answer_of(const rough::Profile& profile, const std::string& name) {
    const rough::Curve curve = secant_stiffness(respond(profile, {}, {}));
    Target target;
    target.name = name;
    target.x = Eigen::VectorXd::LinSpaced(20, curve.to / 20, curve.to);
    target.y = target.x.unaryExpr([&](double p) { return curve.at(p); });
    return target;
}

template <class Height>
rough::Profile profile_of(Height height) {
    rough::Profile profile{Eigen::VectorXd(grid.nodes), grid.spacing()};
    for (Index i = 0; i < grid.nodes; ++i)
        profile.heights[i] = height(grid.spacing() * static_cast<double>(i));
    return profile;
}

template <class Stiffness>
Target formula(const std::string& name, Stiffness stiffness) {
    Target target;
    target.name = name;
    target.x = Eigen::VectorXd::LinSpaced(20, 8e-6, 1.6e-4);
    target.y = target.x.unaryExpr([&](double p) { return stiffness(p / 1.6e-4); });
    return target;
}

inline std::vector<Asked> targets() {
    std::vector<Asked> all;
    std::mt19937_64 random(2020);
    for (int i = 0; i < 7; ++i)
        all.push_back({answer_of(sample(rough::testing::random_genome(
                                            random, 1 + i % 2, 1 + static_cast<std::size_t>(i % 3), 0.84942,
                                            (i < 4 ? 8 : 2) * grid.spacing()),
                                        grid),
                                 "genome " + std::to_string(i + 1)),
                       true});
    for (const double H : {0.6, 0.75, 0.9})
        all.push_back({answer_of(rough::fractal_profile(grid, H, 1e-3, 7),
                                 "Brownian, H = " + std::to_string(H).substr(0, 4)),
                       true});
    for (const double part : {0.3, 0.6}) { // its highest part ground away, with a little left
        rough::Profile ground = rough::fractal_profile(grid, 0.9, 1e-3, part < 0.5 ? 8 : 9);
        const double top = ground.heights.maxCoeff(), cut = top - part * (top - ground.heights.minCoeff());
        for (double& z : ground.heights)
            z = z > cut ? cut + 0.05 * (z - cut) : z;
        all.push_back({answer_of(ground, "ground by " + std::to_string(part).substr(0, 3)), true});
    }
    for (const int bumps : {2, 5}) {
        std::uniform_real_distribution<double> place(0, grid.length), radius(0.5, 3), height(0, 3e-3);
        std::vector<std::array<double, 3>> all_bumps;
        for (int b = 0; b < bumps; ++b)
            all_bumps.push_back({place(random), radius(random), height(random)});
        all.push_back({answer_of(profile_of([&](double x) {
                                     double z = -1;
                                     for (const auto& [at, r, h] : all_bumps)
                                         z = std::max(z, h - (x - at) * (x - at) / (2 * r));
                                     return z;
                                 }),
                                 std::to_string(bumps) + " Hertzian bumps"),
                       true});
    }
    all.push_back({formula("root", [](double t) { return 0.3 + 0.7 * std::sqrt(t); }), true});
    all.push_back({formula("line", [](double t) { return 0.45 + 0.5 * t; }), true});
    all.push_back({formula("late rise", [](double t) { return 0.5 + 0.5 * t * t; }), true});
    all.push_back({formula("falling", [](double t) { return 0.8 - 0.2 * t; }), false});
    all.push_back({formula("too stiff", [](double t) { return 0.5 + 1.2 * t; }), false});
    all.push_back({formula("hump", [](double t) { return 0.5 + 1.2 * t * (1 - t); }), false});
    return all;
}

} // namespace suite
