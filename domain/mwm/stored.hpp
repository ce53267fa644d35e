#pragma once

#include "domain/mwm/genome.hpp"

#include <nlohmann/json.hpp>

/// @file
/// Genomes as checkpoints hold them, without loss, the scale apart. (A genome file for people is
/// genome_json.hpp's.)
namespace rough {

/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Chromosome, n, phases)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Series, A, H, gamma, lambda, chromosomes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Genome, scale, series)
/// @endcond

} // namespace rough
