#pragma once

#include "domain/problem/pipeline.hpp"

namespace rough {

/// The ways to search that have a name, as text. Those that do not begin with `shape`, `own` or `sample` work
/// on the Sobol database. `default` begins anew while no answer has the required similarity.
ga::Variants design_variants(double required = default_required_similarity);

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
