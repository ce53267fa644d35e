#pragma once

#include "domain/database/store.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// A stored genome and how well its curves meet the targets.
struct Match {
    std::uint64_t index = 0; ///< of the genome in its database, from 0
    double similarity = 0;   ///< 1 - the largest misfit of all targets (Eq. 12)
    double scale = 1;        ///< of the genome's amplitude
};

/// What screening is to look for.
struct ScreenOptions {
    double max_pressure = 0; ///< MPa: every genome is rescaled to it by Eq. 11; 0: amplitude is free
    std::size_t best = 10;   ///< how many matches to return
    int threads = 0;         ///< 0: all
};

/// Whether targets need the stored contact fractions.
bool need_fractions(const std::vector<Target>& targets);

/// The stored genomes nearest to the targets, best first; equal similarities by index. Genomes whose curves
/// end before a target does are left out. Where amplitude is free, each genome takes the best of 33
/// amplitudes from the least whose curves reach 2 % beyond the targets up to 16 times that; the best are then
/// narrowed between its neighbours. Throws InputError when a target reaches beyond max_pressure, or nothing
/// is stored.
std::vector<Match> screen(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets,
                          const ScreenOptions& options);

} // namespace rough
