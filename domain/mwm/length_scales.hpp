#pragma once

#include "domain/mwm/waves.hpp"

namespace rough {

/// Chromosomes of one wave number, of any series: one length scale of the profile.
struct LengthScale {
    double wave_number;                                       ///< rad/mm
    std::vector<std::pair<std::size_t, std::size_t>> members; ///< series, chromosome
};

/// All of a genome, each once.
std::vector<LengthScale> length_scales(const Genome& genome);

/// The genome without its other length scales.
Genome only(const Genome& genome, const LengthScale& scale);

} // namespace rough
