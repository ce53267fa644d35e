#pragma once

#include "domain/contact/solve.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

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

/// Heights by Eq. 1-3 as printed, ridge by ridge.
inline rough::Profile profile_of(const nlohmann::json& genome, rough::Index nodes, double length,
                                 bool periodic) {
    rough::Profile profile{Eigen::VectorXd::Zero(nodes),
                           length / static_cast<double>(periodic ? nodes : nodes - 1)};
    for (const auto& series : genome["series"])
        for (const auto& chromosome : series["chromosomes"]) {
            const double n = chromosome["n"], gamma = series["gamma"], H = series["H"];
            const double base = 2 * std::numbers::pi / series["lambda"].get<double>();
            const auto phases = chromosome["phases"].get<std::vector<double>>();
            const double amplitude = series["A"].get<double>() *
                                     std::sqrt(std::log10(gamma) / static_cast<double>(phases.size())) *
                                     std::pow(base, -H) * std::pow(gamma, -(n - 1) * H);
            const double wave_number = base * std::pow(gamma, n - 1);
            for (const double phase : phases)
                for (rough::Index i = 0; i < nodes; ++i)
                    profile.heights[i] +=
                        amplitude *
                        (std::cos(phase) -
                         std::cos(wave_number * static_cast<double>(i) * profile.spacing + phase));
        }
    return profile;
}

inline std::vector<Reference> reference_curves() {
    std::ifstream file(std::string(RUGOSA_TEST_DATA) + "/curves.json");
    std::vector<Reference> scenes;
    for (const auto& scene : nlohmann::json::parse(file)) {
        Reference r;
        r.name = scene["name"];
        const std::string kernel = scene["kernel"];
        r.body.kernel = kernel == "free"       ? rough::Kernel::free
                        : kernel == "periodic" ? rough::Kernel::periodic
                                               : rough::Kernel::strip;
        r.body.effective_modulus = scene["effective_modulus_MPa"];
        if (!scene["datum_mm"].is_null())
            r.body.datum = scene["datum_mm"];
        if (!scene["strip_width_mm"].is_null())
            r.body.strip_width = scene["strip_width_mm"];
        r.profile = profile_of(scene["genome"], scene["nodes"], scene["length_mm"], kernel == "periodic");
        r.displacement = scene["displacement_mm"].get<std::vector<double>>();
        r.pressure = scene["pressure_MPa"].get<std::vector<double>>();
        r.tangent_stiffness = scene["tangent_stiffness_MPa_per_mm"].get<std::vector<double>>();
        r.contact_nodes = scene["contact_nodes"].get<std::vector<int>>();
        scenes.push_back(std::move(r));
    }
    return scenes;
}

} // namespace scenes
