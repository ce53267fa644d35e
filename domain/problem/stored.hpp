#pragma once

#include "domain/mwm/stored.hpp"
#include "domain/problem/problem.hpp"

/// What checkpoints hold of a design: outcomes without loss, and the set-up that a run belongs to.
namespace rough {

///@{
/// Vectors as checkpoints hold them, without loss.
inline std::vector<double> numbers_of(const Eigen::VectorXd& vector) {
    return {vector.begin(), vector.end()};
}
inline Eigen::VectorXd vector_from(const nlohmann::json& j) {
    const auto numbers = j.get<std::vector<double>>();
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}
///@}

/// As checkpoints hold it, without loss.
inline void to_json(nlohmann::json& j, const DesignOutcome& outcome) {
    nlohmann::json misfits = nlohmann::json::array();
    for (const Eigen::VectorXd& misfit : outcome.misfits)
        misfits.push_back(numbers_of(misfit));
    j = {outcome.scale, std::move(misfits), outcome.excess, outcome.genome};
}
/// As to_json wrote it.
inline void from_json(const nlohmann::json& j, DesignOutcome& outcome) {
    outcome = {j.at(0), {}, j.at(2), j.at(3).get<Genome>()};
    for (const auto& misfit : j.at(1))
        outcome.misfits.push_back(vector_from(misfit));
}

///@{
/// As to_json wrote it, without loss; ContactOptions::stop is left out.
inline void to_json(nlohmann::json& j, const Model& model) {
    const auto& [grid, body, loading, contact, accuracy] = model;
    const auto& [nodes, length, wraps, from, rows, width] = grid;
    const auto& [kernel, modulus, datum, strip_width, hardness] = body;
    const auto& [steps, reach, to_pressure, to_displacement, pressures] = loading;
    const auto& [solver, tolerance, states, memory_limit, stop] = contact;
    j = {{nodes, length, wraps, from, rows, width},
         {static_cast<int>(kernel), modulus, datum, strip_width, hardness},
         {steps, reach, to_pressure, to_displacement, pressures},
         {static_cast<int>(solver), tolerance, states, memory_limit},
         accuracy};
}
inline void from_json(const nlohmann::json& j, Model& model) {
    const auto &g = j.at(0), &b = j.at(1), &l = j.at(2), &c = j.at(3);
    model.grid = {g.at(0), g.at(1), g.at(2), g.at(3), g.at(4), g.at(5)};
    model.body = {static_cast<Kernel>(b.at(0).get<int>()), b.at(1), b.at(2), b.at(3), b.at(4)};
    model.loading = {l.at(0), l.at(1), l.at(2), l.at(3), l.at(4).get<std::vector<double>>()};
    model.contact = {static_cast<Solver>(c.at(0).get<int>()), c.at(1), c.at(2), c.at(3), {}};
    model.accuracy = j.at(4);
}

inline void to_json(nlohmann::json& j, const Target& target) {
    const auto& [quantity, name, x, y, lower, upper, weight, recorded] = target;
    j = {static_cast<int>(quantity), name,   numbers_of(x), numbers_of(y), numbers_of(lower),
         numbers_of(upper),          weight, recorded};
}
inline void from_json(const nlohmann::json& j, Target& target) {
    target = {static_cast<Quantity>(j.at(0).get<int>()),
              j.at(1),
              vector_from(j.at(2)),
              vector_from(j.at(3)),
              vector_from(j.at(4)),
              vector_from(j.at(5)),
              j.at(6),
              j.at(7).get<std::map<std::string, std::string>>()};
}

inline void to_json(nlohmann::json& j, const DesignSetup& setup) {
    const auto& [model, targets, max_pressure, threshold, bounds, phases, limits, like, required, ridges] =
        setup;
    const auto& [H_from, H_to, gamma_from, gamma_to, lambda_from, lambda_to] = bounds;
    const auto& [shortest_wave, max_slope, max_height, min_radius] = limits;
    const auto known = [](const auto& value) { return value ? nlohmann::json(*value) : nlohmann::json(); };
    j = {model,
         targets,
         known(max_pressure),
         known(threshold),
         {H_from, H_to, gamma_from, gamma_to, lambda_from, lambda_to},
         phases ? nlohmann::json{phases->relative, phases->absolute} : nlohmann::json(),
         {shortest_wave, max_slope, max_height, min_radius},
         like ? nlohmann::json{numbers_of(like->heights), like->spacing, like->rows, like->row_spacing}
              : nlohmann::json(),
         required,
         ridges};
}
inline void from_json(const nlohmann::json& j, DesignSetup& setup) {
    const auto number = [](const nlohmann::json& value) {
        return value.is_null() ? std::nullopt : std::optional(value.get<double>());
    };
    const auto &b = j.at(4), &p = j.at(5), &l = j.at(6), &like = j.at(7);
    setup = {.model = j.at(0).get<Model>(),
             .targets = j.at(1).get<std::vector<Target>>(),
             .max_pressure = number(j.at(2)),
             .threshold = number(j.at(3)),
             .bounds = {b.at(0), b.at(1), b.at(2), b.at(3), b.at(4), b.at(5)},
             .limits = {l.at(0), l.at(1), l.at(2), l.at(3)},
             .required_similarity = j.at(8),
             .ridges = j.at(9)};
    if (!p.is_null())
        setup.phases = PhaseReach{p.at(0), p.at(1)};
    if (!like.is_null())
        setup.like = Profile{vector_from(like.at(0)), like.at(1), like.at(2), like.at(3)};
}
///@}

/// Everything of a set-up that decides a result.
inline nlohmann::json description(DesignSetup setup) {
    for (Target& target : setup.targets) {
        target.name.clear();
        target.recorded.clear();
    }
    return setup;
}

} // namespace rough
