#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/response.hpp"
#include "ga/base/json.hpp"
#include "ga/run/state.hpp"

namespace rough {
struct AccuracyReport;
struct DesignSetup;
struct SearchResult;
struct Target;
} // namespace rough

/// The record of a run, from which result files and pages are written. An unknown number is NaN.
namespace app {

/// The data needed to repeat it.
struct Origin {
    std::string kind;    ///< kind of the result, which names the template of its page
    std::string command; ///< as it was typed
    std::uint64_t seed = 1;
    int threads = 1;
    nlohmann::json inputs = nlohmann::json::array(); ///< files that it reads, by inputs_json()
};

/// A genome, scaled by Eq. 11, and its response, whose last pressure is p_max.
struct Answered {
    rough::Genome genome;
    rough::Response response;
};

struct Candidate {
    std::uint64_t id = 0;               ///< kept by refinement; database genomes are 0..99 in their order
    std::vector<std::uint64_t> parents; ///< none, or the two united genomes
    double similarity = 0;              ///< similarity over all points; NaN if the stage did not score it
};

/// The population after one stage.
struct StageRecord {
    std::string path; ///< e.g. "sog/refine.2"
    std::vector<Candidate> candidates;
    double spent = 0;     ///< price of the run so far, in contact curves on its grid in its load steps
    bool derived = false; ///< whether it is part of a stage under a derived problem, which a resumed run repeats
};

/// The run of one variant.
struct VariantRun {
    std::string name;                ///< e.g. sog-minimax
    std::string pipeline;            ///< pipeline that ran; "" if it was composed in code
    std::vector<StageRecord> stages; ///< in order; the stage before the first "refine" is GCMMA (0)
    std::vector<std::string> notes;  ///< the engine's remarks, e.g. that a threshold took its "at least"
    Answered answer;
    double similarity = 0;          ///< similarity of the answer on the run's grid
    double similarity_refined = 0;  ///< similarity on the finer grid, with Eq. 11 applied again
    double similarity_worst = 0;    ///< verdict: on the finer grid in finer load steps, less the error
    double seconds = 0;             ///< wall time
    long curves = 0, gradients = 0; ///< evaluations and derivatives at all levels
    double price = 0;               ///< their cost, in contact curves on the run's grid in its load steps
};

/// Number of candidates up to which every generation is kept. Then the record of a stage replaces its last one.
constexpr std::size_t max_candidates = 200000;

/// An observer that records the candidates of every stage, with the problem's first objective as similarity.
template <class G = rough::Genome>
ga::Observer<G> recorder(std::vector<StageRecord>& stages) {
    return [&stages, counted = std::size_t{0}, candidates = std::size_t{0}](const ga::Event<G>& event) mutable {
        while (counted == 0 && !stages.empty() && stages.back().derived) // its stage was interrupted
            stages.pop_back();
        StageRecord record{event.path, {}, event.counters.price, event.derived};
        for (const auto& individual : event.population) {
            const bool scored = individual.fitness.known() && individual.fitness.objective() == "similarity";
            record.candidates.push_back({individual.identity,
                                         {individual.parents.begin(), individual.parents.end()},
                                         scored ? individual.value() : std::numeric_limits<double>::quiet_NaN()});
        }
        for (; counted < stages.size(); ++counted) // one more, or those of a resumed run
            candidates += stages[counted].candidates.size();
        const auto last = candidates < max_candidates
                              ? stages.rend()
                              : std::find_if(stages.rbegin(), stages.rend(),
                                             [&](const StageRecord& each) { return each.path == event.path; });
        if (last == stages.rend())
            stages.push_back(std::move(record));
        else
            *last = std::move(record);
    };
}

///@{
/// The form in checkpoints, and in result.json except `spent` and `derived`.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Candidate, id, parents, similarity)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageRecord, path, candidates, spent, derived)
///@}
/// The similarities and the cost of a run, as in result.json.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VariantRun, similarity, similarity_refined, similarity_worst, seconds, curves,
                                   gradients, price)
/// The keys of origin_json() that a run knows.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Origin, kind, command, seed, threads, inputs)

/// The record of a search under a name, without the response of its answer.
VariantRun variant_run(const std::string& name, const rough::SearchResult& found, std::vector<StageRecord> stages,
                       double seconds);

/// The model: grid, body, load steps.
nlohmann::json model_json(const rough::Model& model);

/// Name and points of a target, with the columns of its file as keys.
nlohmann::json target_json(const rough::Target& target);

/// The keys of every result.json: version of the program, command, seed and threads.
nlohmann::json origin_json(const Origin& origin);

/// result.json of the runs of one or several variants, to which a kind of run adds keys. The set-up is that
/// of the searches. Each variant has its stages, its answer, and an account of the answer's model per kind of
/// load. On the free half-plane it has dK/d ln d per load step.
nlohmann::json result_json(const Origin& origin, const rough::DesignSetup& setup,
                           const std::vector<VariantRun>& variants);

/// An account as in CURVE.json and result.json. It has nodes, steps, used and dropped chromosomes with their
/// bound, solver, tolerance, seconds, estimated errors, and a description in words.
nlohmann::json account_json(const rough::AccuracyReport& account);

} // namespace app
