#pragma once

#include "domain/problem/pipeline.hpp"

namespace rough {

/// The named variants as texts. `default` and `like` restart until an answer has the similarity `required`.
/// Variants that do not begin with `shape`, `own` or `sample` start from the Sobol database.
ga::Variants design_variants(double required = default_required_similarity);

/// The name of the variant for a set-up if no pipeline is given; `stored`: with starts from a database.
std::string usual_variant(const DesignSetup& setup, bool stored = false);

/// The operators of text pipelines for a design. It has those of the engine and the paper. It adds the starts
/// `shape` and `own`, and `fit`. The added blocks are `coarser`, `corrected` and `within-limits`. It also has
/// `reduce goalK` for each target K, and choices of phases by wavelength.
ga::Registry<DesignProblem> design_registry(const DesignSetup& setup);

/// The pipeline of a text of these operators and of named variants. If shapes are limited and the text has no
/// `within-limits`, that becomes its last stage. Throws ga::UsageError on a text that is not a pipeline.
Pipeline design_pipeline(const DesignSetup& setup, const std::string& text);

} // namespace rough
