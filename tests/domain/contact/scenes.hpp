#pragma once

#include "domain/contact/solve.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
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

/// The 100 one-series genomes of tests/data/database.csv: lambda = L = 0.84942 mm, A = 1, M = 1, waves down
/// to L/511 whatever the number of nodes.
inline std::vector<rough::Profile> database(rough::Index nodes) {
    std::ifstream file(std::string(RUGOSA_TEST_DATA) + "/database.csv");
    std::vector<std::vector<double>> pairs, phases;
    std::string line;
    std::getline(file, line); // the header
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string kind, cell;
        std::getline(cells, kind, ',');
        std::getline(cells, cell, ',');
        std::vector<double> values;
        while (std::getline(cells, cell, ',') && !cell.empty())
            values.push_back(std::stod(cell));
        if (kind == "pair_H_gamma")
            pairs.push_back(values);
        else
            phases.push_back(values);
    }
    const double length = 0.84942;
    std::vector<rough::Profile> profiles;
    for (const auto& pair : pairs)
        for (std::size_t column = 0; column < 5; ++column) {
            nlohmann::json series{{"A", 1}, {"H", pair[0]}, {"gamma", pair[1]}, {"lambda", length}};
            for (std::size_t n = 1;
                 n <= phases.size() && std::pow(pair[1], 1.0 - double(n)) >= (1 - 1e-12) / 511; ++n)
                series["chromosomes"].push_back({{"n", n}, {"phases", {phases[n - 1][column]}}});
            profiles.push_back(profile_of({{"series", {series}}}, nodes, length, false));
        }
    return profiles;
}

/// t range, t = reach j/steps, j = 1..steps, mm
inline std::vector<double> load_steps(const rough::Profile& profile, int steps, double reach = 1) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    std::vector<double> displacements;
    for (int j = 1; j <= steps; ++j)
        displacements.push_back(reach * j / steps * range);
    return displacements;
}

} // namespace scenes
