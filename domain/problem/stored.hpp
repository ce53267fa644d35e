#pragma once

#include "domain/mwm/stored.hpp"
#include "domain/problem/problem.hpp"

/// @file
/// Outcomes and set-ups as checkpoints hold them, without loss, except ContactOptions::stop and threads.

/// @cond
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
    static void to_json(json& j, const std::optional<T>& value) { j = value ? json(*value) : json(); }
    static void from_json(const json& j, std::optional<T>& value) {
        value = j.is_null() ? std::nullopt : std::optional(j.get<T>());
    }
};
template <>
struct nlohmann::adl_serializer<Eigen::VectorXd> {
    static void to_json(json& j, const Eigen::VectorXd& vector) {
        j = std::vector<double>(vector.begin(), vector.end());
    }
    static void from_json(const json& j, Eigen::VectorXd& vector) {
        const auto numbers = j.get<std::vector<double>>();
        vector = Eigen::VectorXd::Map(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    }
};

namespace rough {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DesignOutcome, scale, misfits, excess, similarity)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Grid, nodes, length, periodic, from, rows, width, from_y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Layer, thickness, modulus, poissons_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Layering, layers, rigid_base, poissons_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Body, kernel, effective_modulus, datum, strip_width, hardness, layering)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Loading, steps, reach, to_pressure, to_displacement, pressures, shares)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ContactOptions, solver, tolerance, states, memory_limit)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Model, grid, body, loading, contact, accuracy)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Target, quantity, name, x, y, lower, upper, weight, recorded)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GeneBounds, H_from, H_to, gamma_from, gamma_to, lambda_from, lambda_to)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PhaseReach, relative, absolute)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MakingLimits, shortest_wave, max_slope, max_height, min_radius)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Profile, heights, spacing, rows, row_spacing)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MakingErrors, noise, noise_length, tilt)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DesignSetup, model, targets, max_pressure, threshold, bounds, phases, limits,
                                   measured, required_similarity, ridges, smooth_area, errors)
/// @endcond

/// A set-up without the names and records of its targets, which do not affect a result.
template <class Setup>
nlohmann::json description(Setup setup) {
    for (Target& target : setup.targets) target.name.clear(), target.recorded.clear();
    return setup;
}

} // namespace rough
