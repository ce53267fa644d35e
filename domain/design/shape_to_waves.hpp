#pragma once

#include "domain/mwm/sampling.hpp"

#include <vector>

namespace rough {

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

} // namespace rough
