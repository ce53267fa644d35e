#pragma once

#include "domain/mwm/genome.hpp"
#include "ga/base/random.hpp"

namespace rough {

/// Cross-over of length scales: the chromosomes of each genome, ordered from the longest wave to the
/// shortest, change places; each keeps its own series' genes and its profile's scale. Chromosomes that end up
/// beside others of equal series genes form one series with them; series left empty go. Numbers of
/// chromosomes stay.

/// Exchanges every other piece between `cuts` cuts at places both genomes have.
void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream);

/// Exchanges each place that both genomes have with probability 1/2.
void cross_uniform(Genome& a, Genome& b, ga::Stream& stream);

} // namespace rough
