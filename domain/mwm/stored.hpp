#pragma once

#include "domain/mwm/genome.hpp"

#include <nlohmann/json.hpp>

/// @file
/// Genomes as checkpoints hold them, without loss, the scale apart. (A genome file for people is
/// genome_json.hpp's.)
namespace rough {

///@{
/// As checkpoints hold it: undone by its counterpart; from_json throws nlohmann's exceptions on anything
/// else.
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
///@}

} // namespace rough
