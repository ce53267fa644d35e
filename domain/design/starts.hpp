#pragma once

#include "domain/problem/drawn_start.hpp"

namespace rough {

/// A genome near the set-up's first target. One to eight asperities of equal height are drawn. Nodes near
/// them come into contact first. inverse_profile() gives the profile for this order, on at most 256 nodes (a
/// map: 24 x 24). shaped_as() fits waves to this profile. They are two drawn series within the set-up's
/// bounds, on a map two equal series, on a periodic line the harmonics of the length.
///
/// If the set-up has noise, a line gets tips at an even pitch instead, with valleys that do not touch. The
/// pitch is 2 to 6 times the noise length or the shortest wavelength, whichever is longer. The waves are then
/// all harmonics of one length.
Genome shaped_start(const DesignSetup& setup, ga::Stream random);

/// On a periodic line, the genome with its waves moved to harmonics of the length; otherwise the genome.
Genome fitting_grid(const DesignSetup& setup, const Genome& genome);

/// The paper's Sobol database within the set-up's bounds, each genome with_fitting_amplitude().
std::vector<Genome> database_starts(const DesignSetup& setup, int threads);

/// The genome with the given series that follows the heights most closely, by least squares. A and
/// chromosomes of the series are not read. Each chromosome n = 1 .. n_f down to the wavelength `shortest`
/// (mm) has two ridges. Their phases make one cosine of any amplitude up to 2 G_n (Eq. 7). A is the smallest
/// value with which every cosine needs at most 0.9 of this bound. `damping` limits the waves, relative to the
/// heights. Throws InputError if the longest wave of a series is shorter than `shortest`.
Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest, double damping = 1e-6);

/// The genome for a map: two copies of the series `law`, with `ridges` directions per chromosome. Each wave
/// vector then has two phases, which give any amplitude up to 2 G_n. plane_waves() gives the wave vectors on
/// `grid`, which has the map's lengths but may have other nodes.
Genome shaped_as(const Profile& map, const Series& law, int ridges, const Grid& grid, double shortest,
                 double damping = 1e-4);

/// The number of wavelengths 2 L/k (periodic grid: L/k) that the set-up allows.
Index max_scan_waves(const DesignSetup& setup);

/// The measured profile (DesignSetup::measured) as a sum of waves of length 2 L/k (mm; periodic grid: L/k), k
/// = 1 to `waves`. Each wave is a series of one chromosome. The waves are fitted by least squares. Nodes that
/// contact depends on have the largest weight: nodes that touch under the targets' last load, and nodes below
/// the sum of the waves. Throws InputError without a measured profile or with a map.
Genome scan_waves(const DesignSetup& setup, Index waves);
/// A sum of waves of random phases with the measured map's spectrum (DesignSetup::measured). Wavelengths are
/// a constant factor apart, from the shortest allowed one to the map's length. Each is two series of one
/// chromosome. In each direction they have the power of the map's waves near that length and direction.
/// Throws InputError without a measured map.
Genome waves_like(const DesignSetup& setup, ga::Stream random);
/// The price of the contact that scan_waves() solves, in curves of the set-up's model.
double scan_waves_price(const DesignSetup& setup);

} // namespace rough
