#pragma once

#include "domain/fitness/rescaled_problem.hpp"

#include <nlohmann/json.hpp>

/// @file
/// Genomes and responses as checkpoints hold them: without loss, the scale apart. (A genome file for people
/// is mwm/genome_json.hpp's.)
namespace rough {

///@{
/// Undone by its counterpart; from_json throws nlohmann's exceptions on anything else.
inline void to_json(nlohmann::json& j, const Chromosome& chromosome) {
    j = {chromosome.n, chromosome.phases};
}
inline void from_json(const nlohmann::json& j, Chromosome& chromosome) {
    chromosome = {j.at(0).get<int>(), j.at(1).get<std::vector<double>>()};
}

inline void to_json(nlohmann::json& j, const Series& series) {
    j = {series.A, series.H, series.gamma, series.lambda, series.chromosomes};
}
inline void from_json(const nlohmann::json& j, Series& series) {
    series = {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4).get<std::vector<Chromosome>>()};
}

inline void to_json(nlohmann::json& j, const Genome& genome) { j = {genome.scale, genome.series}; }
inline void from_json(const nlohmann::json& j, Genome& genome) {
    genome = {j.at(0).get<double>(), j.at(1).get<std::vector<Series>>()};
}

inline std::vector<double> numbers_of(const Eigen::VectorXd& vector) {
    return {vector.begin(), vector.end()};
}
inline Eigen::VectorXd vector_from(const nlohmann::json& j) {
    const auto numbers = j.get<std::vector<double>>();
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

inline void to_json(nlohmann::json& j, const RescaledResponse& outcome) {
    const Response& r = outcome.response;
    j = {outcome.scale,
         {numbers_of(outcome.stiffness.x), numbers_of(outcome.stiffness.y), outcome.stiffness.from,
          outcome.stiffness.to},
         {r.range, numbers_of(r.displacement), numbers_of(r.pressure), numbers_of(r.contact_fraction),
          numbers_of(r.tangent_stiffness), numbers_of(r.kkt_residual), static_cast<int>(r.solver)}};
}
inline void from_json(const nlohmann::json& j, RescaledResponse& outcome) {
    const auto &k = j.at(1), &r = j.at(2);
    outcome.scale = j.at(0);
    outcome.stiffness = {vector_from(k.at(0)), vector_from(k.at(1)), k.at(2), k.at(3)};
    outcome.response = {};
    outcome.response.range = r.at(0);
    outcome.response.displacement = vector_from(r.at(1));
    outcome.response.pressure = vector_from(r.at(2));
    outcome.response.contact_fraction = vector_from(r.at(3));
    outcome.response.tangent_stiffness = vector_from(r.at(4));
    outcome.response.kkt_residual = vector_from(r.at(5));
    outcome.response.solver = static_cast<Solver>(r.at(6).get<int>());
}
///@}

} // namespace rough
