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

/// The genome of the given series (A and chromosomes are not read) that follows the heights most closely:
/// each chromosome n = 1 .. n_f with waves down to `shortest` (mm) is given two ridges, whose phases make one
/// cosine of any amplitude up to 2 G_n (Eq. 7), so that the best amplitudes and phases are a linear
/// least-squares problem; A is the smallest that lets 0.9 of the bound serve. Waves are held down by
/// `damping` relative to the heights. Throws InputError when a series has no wave that long.
Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest,
                 double damping = 1e-6);

/// The same on an area: two series of one law (A and chromosomes are not read) with `ridges` directions to a
/// chromosome, so that each wave vector has two phases and with them any amplitude up to 2 G_n. Wave vectors
/// are those that `grid` takes (plane_waves); the map has its lengths, and nodes of its own.
Genome shaped_as(const Profile& map, const Series& law, int ridges, const Grid& grid, double shortest,
                 double damping = 1e-4);

/// How many waves of 2 L/k (on a grid that is periodic L/k) are no shorter than the set-up allows.
Index max_scan_waves(const DesignSetup& setup);

/// The measured profile (DesignSetup::like) as a sum of waves of 2 L/k (mm; on a grid that is periodic L/k),
/// k = 1 to `waves`, each a series of one chromosome. With as many waves as nodes it would answer like the
/// profile by construction; of fewer the sum is fitted by least squares, in which nodes that touch under the
/// targets' last load, and those where the sum would stand above the profile, weigh most: contact sees no
/// others. Throws InputError where no profile was measured.
Genome scan_waves(const DesignSetup& setup, Index waves);

} // namespace rough
