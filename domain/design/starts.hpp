#pragma once

#include "domain/problem/drawn_start.hpp"

namespace rough {

/// A genome near the set-up's first target. The order in which nodes come into contact is drawn: one asperity
/// or several of equal height. inverse_profile() gives the profile for it, on at most 256 nodes (a map: 24
/// x 24). shaped_as() fits waves to that. They are two drawn series within the set-up's bounds, on a periodic
/// line the harmonics of the length, on a map two equal series. Such profiles do not look rough. They are
/// near the target and have few contacts that open and close, which makes them good starts for refinement.
Genome shaped_start(const DesignSetup& setup, ga::Stream random);

/// On a periodic line, the genome with its waves moved to harmonics of the length; otherwise the genome.
Genome fitting_grid(const DesignSetup& setup, const Genome& genome);

/// The paper's Sobol database within the set-up's bounds, each genome in its best amplitude.
std::vector<Genome> database_starts(const DesignSetup& setup, int threads);

/// The genome of the given series that follows the heights most closely, by least squares. A and chromosomes
/// of the series are not read. Each chromosome n = 1 .. n_f down to the wavelength `shortest` (mm) has two
/// ridges, whose phases make one cosine of any amplitude up to 2 G_n (Eq. 7). A is the smallest that needs at
/// most 0.9 of this bound. `damping` limits the waves, relative to the heights. Throws InputError if a series
/// has no wave that long.
Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest,
                 double damping = 1e-6);

/// The genome for a map: two series of one law with `ridges` directions per chromosome. Each wave vector then
/// has two phases, which give any amplitude up to 2 G_n. Wave vectors are those of `grid` (plane_waves),
/// which has the map's lengths but may have other nodes.
Genome shaped_as(const Profile& map, const Series& law, int ridges, const Grid& grid, double shortest,
                 double damping = 1e-4);

/// The number of wavelengths 2 L/k (periodic grid: L/k) that the set-up allows.
Index max_scan_waves(const DesignSetup& setup);

/// The measured profile (DesignSetup::like) as a sum of waves of length 2 L/k (mm; periodic grid: L/k), k = 1
/// to `waves`. Each is a series of one chromosome. They are fitted by least squares. The largest weight is on
/// the nodes that contact depends on: those that touch under the targets' last load, and those below the sum.
/// Throws InputError without a measured profile or with a map.
Genome scan_waves(const DesignSetup& setup, Index waves);

} // namespace rough
