#pragma once

#include "domain/database/store.hpp"
#include "domain/design/search.hpp"

namespace rough {

/// What takes a database's responses to a model of another length and modulus, exactly: a profile drawn out
/// to `length` times its length, its heights kept, on a body whose datum or strip width is drawn out with it,
/// carries E*'/E* / `length` times the pressure at every displacement, on the same nodes.
struct DatabaseScale {
    double length = 1;   ///< wanted over stored
    double pressure = 1; ///< wanted over stored; of stiffness, too
};
/// The scale between a database and a model. Throws InputError naming the first difference where the
/// database's responses are another model's in more than length and modulus.
DatabaseScale scale_to(const GenomeStore& store, const Model& model);
/// A target as it reads under the database's own model.
Target unscaled(Target target, const DatabaseScale& scale);
/// A genome drawn out to `factor` times its wave lengths, its heights kept.
Genome drawn_out(Genome genome, double factor);

/// The stored genomes nearest to a design's targets, best first, drawn out to its length and in the amplitude
/// that meets them: where refinement begins when an answer is wanted at once. At most `count`. Throws
/// InputError as scale_to does.
std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                  int threads = 0);

/// A stored genome as an answer to a design.
struct StoredAnswer {
    std::uint64_t index = 0; ///< of the genome in its database, from 0
    double scale = 1;        ///< of the stored genome's amplitude, from its stored curve
    Answer answer;           ///< drawn out and in that amplitude, verified as a design is (verified_answer)
};

/// The stored genomes whose stored curves are nearest to a design's targets, as `stored_starts`, but verified
/// before they are ranked: stored load steps may be too few for a target. At least 16 are verified, `count`
/// are returned, the highest `similarity_worst` first. Genomes without a response on a finer grid are left
/// out. Throws InputError as scale_to and `validate` of the set-up do.
std::vector<StoredAnswer> stored_answers(const GenomeStore& store, const DesignSetup& setup,
                                         std::size_t count, int threads = 0);

} // namespace rough
