#pragma once

#include "domain/database/store.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// A stored genome and how well its curves meet the targets.
struct Match {
    std::uint64_t index = 0; ///< the genome's number in its database, from 0
    double similarity = 0;   ///< 1 - the largest misfit of all targets (Eq. 12)
    double scale = 1;        ///< factor on the genome's amplitude
};

/// How to screen.
struct ScreenOptions {
    double max_pressure = 0; ///< MPa: every genome is rescaled to it by Eq. 11; 0: amplitude is free
    std::size_t best = 10;   ///< how many matches to return
    int threads = 0;         ///< 0: all
};

/// Whether targets need the stored contact fractions.
bool need_fractions(const std::vector<Target>& targets);

/// The stored genomes nearest to the targets, best first; equal similarities by index. Genomes whose curves
/// end before a target are omitted. If amplitude is free, 33 amplitudes of each genome are compared. The
/// lowest one makes the curves reach 2 % beyond the targets, and the highest is 16 times that. The best are
/// then narrowed between their neighbours. Throws InputError if a target reaches beyond max_pressure, or
/// nothing is stored.
std::vector<Match> screen(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets,
                          const ScreenOptions& options);

} // namespace rough
