#pragma once

#include "domain/contact/solve.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "ga/base/json.hpp"
#include "tests/catch.hpp"

#include <fstream>
#include <random>

namespace scenes {

/// One of tests/data/curves.json: a profile, what it is pressed on, and the curve an independent oracle
/// found.
struct Reference {
    std::string name;
    rough::Profile profile;
    rough::Body body;
    std::vector<double> displacement, pressure, tangent_stiffness;
    std::vector<int> contact_nodes;
};

inline std::vector<Reference> reference_curves() {
    std::ifstream file(std::string(RUGOSA_TEST_DATA) + "/curves.json");
    std::vector<Reference> scenes;
    for (const auto& scene : nlohmann::json::parse(file)) {
        Reference r;
        r.name = scene["name"];
        r.body.kernel = rough::kernel_named(scene["kernel"]);
        r.body.effective_modulus = scene["effective_modulus_MPa"];
        if (!scene["datum_mm"].is_null()) r.body.datum = scene["datum_mm"].get<double>();
        if (!scene["strip_width_mm"].is_null()) r.body.strip_width = scene["strip_width_mm"].get<double>();
        r.profile = sample(rough::genome_from_json(scene["genome"], "scene"),
                           {scene["nodes"], scene["length_mm"], r.body.kernel == rough::Kernel::periodic});
        r.displacement = scene["displacement_mm"].get<std::vector<double>>();
        r.pressure = scene["pressure_MPa"].get<std::vector<double>>();
        r.tangent_stiffness = scene["tangent_stiffness_MPa_per_mm"].get<std::vector<double>>();
        r.contact_nodes = scene["contact_nodes"].get<std::vector<int>>();
        scenes.push_back(std::move(r));
    }
    return scenes;
}

/// A profile on a body, and the displacements that it is pressed to.
struct Scene {
    rough::Profile profile;
    rough::Body body;
    std::vector<double> displacements; ///< mm
};

/// Random scene number k, on the kernel number k % 3, of `fewest` to `fewest + more` nodes. It is a sum of
/// cosines of random amplitude and phase, between smooth and rough, pressed in even steps.
inline Scene random_scene(std::mt19937& random, int k, rough::Index fewest, rough::Index more, int steps) {
    using rough::Index;
    std::uniform_real_distribution<double> uniform(0, 1);
    Scene scene;
    scene.body.kernel = static_cast<rough::Kernel>(k % 3);
    const Index nodes = fewest + static_cast<Index>(uniform(random) * static_cast<double>(more));
    const double length = std::pow(10, 4 * uniform(random) - 2);
    const bool periodic = scene.body.kernel == rough::Kernel::periodic;
    scene.profile = {Eigen::VectorXd::Zero(nodes), length / static_cast<double>(periodic ? nodes : nodes - 1)};
    scene.body.effective_modulus = std::pow(10, 6 * uniform(random));
    scene.body.datum = length * (k % 2 ? 0.3 + 0.6 * uniform(random) : std::pow(10, uniform(random)));
    scene.body.strip_width = scene.profile.spacing * std::pow(10, 4 * uniform(random) - 2);
    const double decay = 0.5 + 1.5 * uniform(random);
    for (int wave = 1; wave < 30; ++wave) {
        const double amplitude = length * std::pow(wave, -decay) * uniform(random), phase = 7 * uniform(random);
        for (Index i = 0; i < nodes; ++i)
            scene.profile.heights[i] +=
                amplitude *
                std::cos(6.283185307179586 * wave * static_cast<double>(i) * scene.profile.spacing / length + phase);
    }
    const double highest = scene.profile.heights.maxCoeff();
    const double reach =
        periodic ? 0.95 * (highest - scene.profile.heights.mean()) : highest - scene.profile.heights.minCoeff();
    for (int j = 1; j <= steps; ++j) scene.displacements.push_back(reach * j / steps);
    return scene;
}

/// t range, t = reach j/steps, j = 1..steps, mm
inline std::vector<double> load_steps(const rough::Profile& profile, int steps, double reach = 1) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    std::vector<double> displacements;
    for (int j = 1; j <= steps; ++j) displacements.push_back(reach * j / steps * range);
    return displacements;
}

/// Checks that a curve has the pressures, tangent stiffnesses and contact fractions of another one, the first
/// two within a relative error.
inline void check_same(const rough::ContactCurve& curve, const rough::ContactCurve& expected, double epsilon) {
    REQUIRE(curve.steps.size() == expected.steps.size());
    for (std::size_t j = 0; j < curve.steps.size(); ++j) {
        const rough::LoadStep &a = curve.steps[j], &b = expected.steps[j];
        CAPTURE(j);
        CHECK(a.pressure == Approx(b.pressure).epsilon(epsilon));
        CHECK(a.tangent_stiffness == Approx(b.tangent_stiffness).epsilon(epsilon));
        CHECK(a.contact_fraction == b.contact_fraction);
    }
}

} // namespace scenes
