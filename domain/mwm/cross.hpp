#pragma once

#include "domain/mwm/genome.hpp"
#include "ga/base/random.hpp"

namespace rough {

/// @file
/// Cross-over of length scales. The chromosomes of each genome, ordered from the longest wavelength
/// to the shortest, change places. Each keeps the genes of its series and the scale of its genome.
/// Chromosomes with equal series genes form one series afterwards, and empty series are removed. Numbers
/// of chromosomes stay.

/// Exchanges every other piece between `cuts` cuts, at places that both genomes have.
void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream);

/// Exchanges each place that both genomes have with probability 1/2.
void cross_uniform(Genome& a, Genome& b, ga::Stream& stream);

} // namespace rough
