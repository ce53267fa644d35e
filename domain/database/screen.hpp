#pragma once

#include "domain/database/store.hpp"
#include "domain/response/target.hpp"

namespace rough {

/// A stored genome and how well its curve meets a target.
struct Match {
    std::uint64_t index = 0;
    double similarity = 0; ///< Eq. 12
    double scale = 1;      ///< of the genome's amplitude
};

/// What screening is to look for.
struct ScreenOptions {
    double max_pressure = 0; ///< MPa: every genome is rescaled to it by Eq. 11; 0: amplitude is free
    std::size_t best = 10;   ///< how many matches to return
    int threads = 0;         ///< 0: all
};

/// The stored genomes nearest to a target by Eq. 12, best first; equal similarities by index.
/// Where amplitude is free, each genome takes the best of 33 amplitudes from the one whose last pressure is
/// 2 % above the target's highest up to 16 times that; the best are then narrowed between its neighbours.
/// Throws InputError when the target reaches beyond max_pressure, or nothing is stored.
std::vector<Match> screen(const StoredCurves& curves, const Model& model, const Target& target,
                          const ScreenOptions& options);

} // namespace rough
