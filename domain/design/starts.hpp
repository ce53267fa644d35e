#pragma once

#include "domain/problem/drawn_start.hpp"

namespace rough {

/// A genome made for the set-up's first target: nodes come into contact in an order that `random` draws (one
/// asperity, or some of equal height, somewhere along the profile), the profile that answers exactly so is
/// found by solving contact backwards (inverse_profile), and two series drawn within the set-up's bounds are
/// laid on it (shaped_as), or on a grid that is periodic the harmonics of its length; on an area, which is
/// solved on at most 24 nodes a side, the twin series of one law. Not rough to the eye, near the target, and
/// with few contacts that come and go: good ground for refinement.
Genome shaped_start(const DesignSetup& setup, ga::Stream random);

/// The genome with waves that repeat where a line's grid is periodic; an area moves those of any genome to
/// its lattice.
Genome fitting_grid(const DesignSetup& setup, const Genome& genome);

/// The paper's Sobol database within the set-up's bounds, each genome in its best amplitude.
std::vector<Genome> database_starts(const DesignSetup& setup, int threads);

} // namespace rough
