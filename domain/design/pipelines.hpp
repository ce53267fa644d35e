#pragma once

#include "domain/design/starts.hpp"
#include "domain/paper/vocabulary.hpp"
#include "domain/problem/pipeline.hpp"

namespace rough {

/// An area's set-up on a grid of half the nodes a side, `halvings` times, as far as 32 nodes remain and the
/// shortest wave can still be told.
DesignSetup on_coarser_grid(DesignSetup setup, std::size_t halvings);
/// Runs `body` under that set-up, where a contact curve costs as many times less.
Pipeline coarser(std::size_t halvings, const Pipeline& body);
/// Runs `body` on the first individual under targets less what its curve changes on finer grids and in finer
/// load steps (corrected_targets), in front of the population that was given.
Pipeline corrected(const Pipeline& body);
/// Where no individual is within the limits on shape: runs `body` on each without so many of its shortest
/// waves that it exceeds the limits least, in front of those that were given. Otherwise it does nothing.
Pipeline within_limits(const Pipeline& body);

/// The set-up whose targets are moved by what a verified answer's curve changes on finer grids and in finer
/// steps: to meet them on the set-up's own grid is to miss the given ones by as much on the one side as on
/// the other.
DesignSetup corrected_targets(DesignSetup setup, const Verification& verified);

/// The ways to search that have a name, as text. Those that do not begin with `shape`, `own` or `sample` work
/// on the Sobol database. `default` begins anew while no answer has the required similarity.
const ga::Variants& design_variants();
/// The same for an answer of this similarity.
ga::Variants design_variants(double required);

/// The name of the variant that a set-up is searched by where nothing else is asked for, with stored genomes
/// to begin with or without. Errors of making choose `made` for a line.
std::string usual_variant(const DesignSetup& setup, bool stored = false);

/// What text pipelines for a design are made of: the engine's words, roughness's, and `shape`, `own`, `fit`,
/// `coarser`, `corrected`, `within-limits`, and `reduce goal1` and on, one a target.
ga::Registry<DesignProblem> design_registry(const DesignSetup& setup);

/// The pipeline of a text made of design_registry's words, in which design_variants may stand as stages.
/// Where shapes are limited and it has no `within-limits`, that is its last stage. Throws ga::UsageError on a
/// text of which none can be made.
Pipeline design_pipeline(const DesignSetup& setup, const std::string& text);

} // namespace rough
