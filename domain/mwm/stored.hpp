#pragma once

#include "domain/mwm/genome.hpp"
#include "ga/base/json.hpp"

/// @file
/// Genomes in checkpoints: lossless, the scale as a separate number. (genome.hpp has the format of genome files.)
namespace rough {

/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Chromosome, n, phases)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Series, A, H, gamma, lambda, chromosomes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Genome, scale, series)
/// @endcond

} // namespace rough
