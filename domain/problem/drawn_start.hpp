#pragma once

#include "domain/problem/setup.hpp"
#include "ga/base/random.hpp"

namespace rough {

/// A series of amplitude 1 without chromosomes, its law moved into the set-up's bounds; lambda in mm.
Series drawn_series(const DesignSetup& setup, double H, double gamma, double lambda);

/// A genome drawn blindly: two series with H in 0.5-1.5, gamma in 1.4-2, lambda near L, within the set-up's
/// bounds, as many ridges as the set-up has, phases and relative amplitude at random; on a line that is
/// periodic the harmonics of its length under one H (an area moves wave vectors to its lattice).
Genome drawn_start(const DesignSetup& setup, ga::Stream random);

/// The genome with the amplitude, at or above the least that carries the target's load within the whole
/// approach, at which its curve meets the first target best: of 33 over 16 octaves, then narrowed. Where Eq.
/// 11 applies the genome is returned as it is.
Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome);

} // namespace rough
