#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/response.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// How a variant came to its answer, as result files, pages and experiments read it. An unknown number is
/// NaN.
namespace app {

/// A genome and what it answers: its scale is Eq. 11's, so that the response's last pressure is p_max.
struct Answered {
    rough::Genome genome;
    rough::Response response;
};

struct Candidate {
    std::uint64_t id = 0; ///< stays when it is refined; database genomes are 0..99 in their order
    std::vector<std::uint64_t> parents; ///< none, or the two that were united
    double similarity = 0;              ///< over all points; NaN where the stage left it unscored
};

/// The population after one stage.
struct StageRecord {
    std::string path; ///< e.g. "sog/refine.2"
    std::vector<Candidate> candidates;
    long spent = 0; ///< contact curves and gradients of the run until then
};

/// One algorithm's way to its answer.
struct VariantRun {
    std::string name;                ///< e.g. sog-minimax
    std::vector<StageRecord> stages; ///< in order; what stands before the first "refine" is GCMMA (0)
    std::vector<std::string> notes;  ///< the engine's remarks, e.g. that a threshold took its "at least"
    Answered answer;
    double similarity = 0;         ///< of the answer, on the run's grid
    double similarity_refined = 0; ///< of the same genome at 4(N-1)+1 nodes, Eq. 11 anew
    double seconds = 0;            ///< wall time
    long curves = 0, gradients = 0;
};

} // namespace app
