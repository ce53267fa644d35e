#pragma once

#include "domain/design/problem.hpp"
#include "ga/random.hpp"

namespace rough {

/// A genome made for the set-up's first goal: nodes come into contact in an order that `random` draws (one
/// asperity, or some of equal height, somewhere along the profile), the profile that answers exactly so is
/// found by solving contact backwards (inverse_profile), and two series drawn within the set-up's bounds are
/// laid on it (shaped_as). Not rough to the eye, near the goal, and with few contacts that come and go: good
/// ground for refinement.
Genome shaped_start(const DesignSetup& setup, ga::Stream random);

/// A genome drawn blindly: two series with H in 0.5-1.5, gamma in 1.4-2, lambda near L, within the set-up's
/// bounds, phases and relative amplitude at random.
Genome drawn_start(const DesignSetup& setup, ga::Stream random);

/// The genome with the amplitude, at or above the least that carries the goal's load within the whole
/// approach, at which its curve meets the first goal best: of 33 over 16 octaves, then narrowed. Where Eq. 11
/// applies the genome is returned as it is.
Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome);

} // namespace rough
