#pragma once

#include "domain/contact/solve.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/mwm/sobol.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
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

/// Heights of a genome as the data files have it.
inline rough::Profile profile_of(const nlohmann::json& genome, rough::Index nodes, double length,
                                 bool periodic) {
    return sample(rough::genome_from_json(genome, "scene"), {nodes, length, periodic});
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

/// The paper's database of 100 one-series genomes: lambda = L = 0.84942 mm, A = 1, M = 1, waves down to L/511
/// whatever the number of nodes.
inline std::vector<rough::Profile> database(rough::Index nodes) {
    std::vector<rough::Profile> profiles;
    const double length = rough::DatabaseLayout().lambda;
    for (const rough::Genome& genome : rough::sobol_database({.shortest = length / 511}))
        profiles.push_back(sample(genome, {nodes, length}));
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
