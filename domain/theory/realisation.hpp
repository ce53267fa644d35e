#pragma once

#include "domain/theory/spectral_moments.hpp"

#include <cstdint>

namespace rough {

/// A surface of these parameters: one cosine for each wave vector of the lattice 2 pi (i/L_x, j/L_y) between
/// the cut-offs, of the spectrum's amplitude and a random phase (so that its power is the spectrum's own), on
/// a grid that wraps; a line where `parameters` are a profile's. The same seed gives the same surface on
/// every grid; waves that a grid does not resolve are sampled, as they are by an instrument. Throws
/// InputError on parameters out of range, and where no wave fits between the cut-offs.
Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed);

} // namespace rough
