#pragma once

#include "domain/paper/variants.hpp"

namespace rough {

/// The named variants as texts. `default` and `like` restart a few times, until an answer has the similarity
/// `required`. Variants that do not begin with `shape`, `own` or `sample` start from the Sobol database.
ga::Variants design_variants(double required = default_required_similarity);

/// The name of the variant for a set-up if no pipeline is given; `stored`: with starts from a database.
std::string usual_variant(const DesignSetup& setup, bool stored = false);

/// The registry of operators for the text pipelines of a design. It has the operators of the engine and of
/// the paper. It adds the stages `shape` and `own`, which make starts, and the stage `fit`. It adds the
/// blocks `coarser`, `corrected` and `within-limits`. It also has `reduce goalK` for each target number K,
/// and choices of phases by wavelength.
ga::Registry<DesignProblem> design_registry(const DesignSetup& setup);

/// The pipeline that a text describes. The text consists of operators of design_registry() and of named
/// variants. If the set-up limits shapes and the text has no `within-limits`, this block becomes the last
/// stage. Throws ga::UsageError on a text that is not a pipeline.
DesignPipeline design_pipeline(const DesignSetup& setup, const std::string& text);

} // namespace rough
