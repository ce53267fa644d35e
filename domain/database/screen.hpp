#pragma once

#include "domain/database/store.hpp"
#include "domain/design/search.hpp"

namespace rough {

/// A stored genome and the similarity of its curves to the targets.
struct Match {
    std::uint64_t index = 0; ///< the genome's number in its database, from 0
    double similarity = 0;   ///< 1 - the largest misfit of all targets (Eq. 12)
    double scale = 1;        ///< factor on the genome's amplitude
};

/// Options of screen().
struct ScreenOptions {
    /// Pressure to which Eq. 11 rescales every genome, MPa. If it is not given, amplitude is free.
    std::optional<double> max_pressure = {};
    std::size_t best = 10; ///< number of matches to return
    int threads = 0;       ///< number of threads; 0: all
};

/// The stored genomes nearest to the targets, best first. Equal similarities are ordered by index. Genomes
/// whose curves end before a target are omitted. If amplitude is free, each genome has its best amplitude, at
/// most 16 times the one at which its curves just extend beyond the targets. Throws InputError if a target
/// extends beyond max_pressure, or if nothing is stored.
std::vector<Match> screen(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets,
                          const ScreenOptions& options);

/// The stored genomes nearest to a design's targets, best first, at most `count`. They are stretched to the
/// design's length, and each has its best amplitude. They are starts for refinement. Throws InputError naming
/// the first difference if database and design differ in more than length and modulus.
std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                  int threads = 0);

/// A stored genome as an answer to a design.
struct StoredAnswer {
    std::uint64_t index = 0; ///< the genome's number in its database, from 0
    double scale = 1;        ///< factor on the stored amplitude, from the stored curve
    Answer answer;           ///< the stretched genome with this amplitude, verified (verified_answer)
};

/// The stored genomes whose stored curves are nearest to a design's targets. Unlike in stored_starts(), the
/// genomes are verified before they are ranked, because stored load steps may be too few for a target. At
/// least 16 profiles are verified. At most `count` are returned, the highest `worst()` first. Genomes without
/// a response on a finer grid are omitted. Throws what stored_starts() and validate() throw.
std::vector<StoredAnswer> stored_answers(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                         int threads = 0);

} // namespace rough
