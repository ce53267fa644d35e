#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/target/target.hpp"
#include "ga/run/context.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The record of a run, which result files, pages and experiments read. An unknown number is NaN.
namespace app {

/// What it takes to repeat a run.
struct Origin {
    std::string kind;             ///< of the result: names the template of its page
    std::string version, command; ///< the command as it was typed
    std::uint64_t seed = 1;
    int threads = 1;
};

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
    std::string pipeline;            ///< as it was run; "" for those composed in code
    std::vector<StageRecord> stages; ///< in order; what stands before the first "refine" is GCMMA (0)
    std::vector<std::string> notes;  ///< the engine's remarks, e.g. that a threshold took its "at least"
    Answered answer;
    double similarity = 0;         ///< of the answer, on the run's grid
    double similarity_refined = 0; ///< of the same genome at 4(N-1)+1 nodes, Eq. 11 anew
    double similarity_worst = 0;   ///< least of these and of four times the load steps on either grid
    double seconds = 0;            ///< wall time
    long curves = 0, gradients = 0;

    /// What an answer is verified by: it must survive finer grids and load steps.
    double lowest() const { return similarity_worst; }
};

/// What one or several variants found for one target.
struct Record {
    Origin origin;
    rough::Model model;                 ///< of the search
    std::vector<rough::Model> loaded;   ///< the same, one for each way in which the target is loaded
    std::optional<double> max_pressure; ///< MPa, of Eq. 11; none: amplitude is a gene
    rough::Target target;
    std::vector<VariantRun> variants;
};

/// So many candidates are kept of every generation; afterwards a stage's record stands in the place of its
/// last.
constexpr std::size_t most_candidates = 200000;

/// An observer that keeps every stage's candidates: identity, parents and similarity (the problem's first
/// objective; NaN where a stage left it unscored).
ga::Observer<rough::Genome> recorder(std::vector<StageRecord>& stages);

///@{
/// As checkpoints keep them, and result.json but for `spent`.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Candidate, id, parents, similarity)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageRecord, path, candidates, spent)
///@}

/// The first record at the path, or nothing.
const StageRecord* stage_at(const std::vector<StageRecord>& stages, const std::string& path);

} // namespace app
