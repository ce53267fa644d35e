#pragma once

#include "domain/mwm/genome.hpp"

namespace rough {

/// One cosine of a profile, as power: half its squared amplitude.
struct SpectralLine {
    double wave_number; ///< k, rad/mm
    double power;       ///< a^2/2, mm^2
};

/// The discrete power spectrum of a cosine series, exact: one line for each wave number, in increasing order;
/// waves of equal wave number (from several series) are added as waves, with their phases. The powers' sum is
/// the mean square height over a length that all wave lengths divide.
std::vector<SpectralLine> discrete_spectrum(const Genome& genome);

} // namespace rough
