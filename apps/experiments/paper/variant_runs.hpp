#pragma once

#include "apps/experiments/paper/run.hpp"
#include "domain/paper/variants.hpp"

#include <optional>

namespace app {

/// A way to search that has a name.
struct NamedPipeline {
    std::string name;
    rough::Pipeline pipeline;
};

/// sog, gco and cco.
std::vector<NamedPipeline> paper_three(const rough::Vocabulary& words);

/// What a run of a pipeline came to, its answer solved throughout; nothing when it was stopped before a
/// genome was scored.
std::optional<VariantRun> finished_run(const std::string& name, const rough::DesignProblem& problem,
                                       const ga::Result<rough::Genome>& result,
                                       std::vector<StageRecord> stages);

/// A run of gco or cco at one threshold (MPa).
ThresholdRow threshold_row(const VariantRun& run, double p_bar);

/// A database's genomes with their responses, rescaled to a pressure by Eq. 11.
std::vector<Answered> answered(const std::vector<rough::Genome>& genomes, const rough::Model& model,
                               double max_pressure, int threads);

/// Each genome's scores on a target whose low part ends at p_bar.
std::vector<Scores> scores_of(const std::vector<Answered>& database, const rough::DesignSetup& setup);

} // namespace app
