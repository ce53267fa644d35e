#pragma once

#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/output.hpp"
#include "apps/report/record.hpp"
#include "apps/report/render.hpp"
#include "domain/asperities/design.hpp"
#include "domain/design/morph.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/checkpoint/checkpoint.hpp"

/// A design from settings to files, for the program and Python.
namespace app {

class Csv;

struct Fact {
    std::string key;  ///< in result.json
    std::string name; ///< heading on the page and the terminal
    std::string text;
};

/// Names of quantities, and the share by which each is off at most.
using Shares = std::map<std::string, double>;

/// A surface in production that is to be brought back to its target.
struct Production {
    std::string file; ///< path of the genome
    rough::Genome genome;
    std::vector<rough::ChromosomeName> control;
    double largest_change = 0; ///< maximum change of a phase, over a turn
};

/// The outcome of a design on the report's first screen, in `summary` of result.json and on the terminal.
struct Summary {
    bool found = false;
    /// The answer's lowest similarity, also under given noise, tilt and hardness; NaN: not verified.
    double verified = 0;
    std::string verdict; ///< in one line
    std::vector<Fact> facts;
};

/// The first words of the verdict on a search without success.
inline std::string missed_by(const rough::SearchRun& run) {
    return run.stopped.empty() ? "not found" : "not found within the budget";
}

/// The parts of a run that designs of every genome have.
struct DesignRecord {
    ga::Stopwatch clock;
    rough::Unreachable unreachable; ///< reasons and bound of the exact tests
    std::vector<StageRecord> stages = {};
    Summary summary = {};
    bool interrupted = false;
    double seconds = 0;
    Origin origin = {};
};

/// Says before a search why it cannot succeed, if there is a reason. `of_what` are the surfaces, in words.
void say_unreachable(const rough::Unreachable& found, const std::string& of_what);

/// The reason why a search stopped, in words. A stop that the user did not request came from the time limit.
inline std::string stop_reason(const std::string& reason, bool is_requested) {
    return reason == "stop requested" && !is_requested ? "time budget spent" : reason;
}

/// Targets of a design and the model in which they hold, from target files or a scan.
struct DesignRequest {
    rough::DesignSetup setup = {};          ///< with the targets, the model and the scan
    std::vector<std::string> accounts = {}; ///< how scans were read, and notes
    std::optional<Production> from = {};    ///< if it is given, it is morphed and nothing is searched
};

/// A design that the settings describe completely.
struct DesignTask : DesignRequest {
    rough::SearchOptions options;
    rough::TrustOptions trust_options;
    rough::ToleranceOptions tolerance_options;
    std::string warning;       ///< that the contact of a scan or map is not resolved; "" if it is
    bool limits_given = false; ///< whether a flag limits the shape
};

struct DesignRun : DesignRecord, DesignTask {
    rough::SearchResult found;
    std::optional<rough::Morphed> morphed;
    rough::DesignResponse response; ///< response of the answer
    std::vector<rough::Margin> margins;
    std::optional<Shares> unrequested_errors;  ///< nothing if the time did not suffice
    std::optional<rough::Tolerance> tolerance; ///< nothing if the run was interrupted
    std::optional<rough::Trust> trust;         ///< nothing if the time did not suffice
};

/// The parameters of a search for designs of any genome.
template <class P>
Bindings bindings_of(rough::SearchOptionsOf<P>& options) {
    return {
        {positive("seconds", "",
                  "wall time of the whole design; a map without time to verify is reported as not verified "
                  "[until the pipeline ends]"),
         options.seconds},
        {whole("evaluations", "", 1, 1e9, "maximum number of curves and gradients [none]"), options.evaluations},
        {whole("alternatives", "", 1, 100,
               "number of different answers [" + std::to_string(rough::SearchOptions().alternatives) +
                   "; 1 for a map, because verifying takes long]"),
         options.alternatives},
        {seed_setting(), options.seed},
        {threads_setting(), options.threads},
    };
}
/// The pipeline of --variant or --pipeline, or the usual one. Throws rough::InputError on an unknown variant.
std::string pipeline_from(const Settings& settings, const std::map<std::string, std::string>& variants,
                          const std::string& usual);

/// The targets of --target with their --weights.
std::vector<rough::Target> targets_from(const Settings& settings, const rough::Model& model);
/// Whether the verdict is about the search grid: that of a changed profile, whose target was measured on it.
bool is_judged_on_grid(const DesignRun& run);
/// The set-up in which the tolerance of a run's answer is found: the similarity without errors is that of the verdict.
rough::DesignSetup toleranced(const DesignRun& run);
/// The options of the tolerance in toleranced(). It costs at most about as much as the search unless --draws is given.
rough::ToleranceOptions priced_tolerance(const DesignRun& run, const rough::DesignSetup& tried);
///@{
/// Parts of result.json.
nlohmann::json trust_json(const rough::Trust& trust);
nlohmann::json tolerance_json(const rough::Tolerance& tolerance);
///@}

/// Adds a row for each point of a target to points.csv, in the units of columns_of(target). Misfits are
/// divided by the weight. `verified` are those that decide; NaN stands for each if the answer is not verified.
void add_points(Csv& points, std::size_t number, const rough::Target& target, const Eigen::VectorXd& misfits,
                const Eigen::VectorXd& verified);
/// The keys of result.json for the record, and for each target its points, file, quantity, and the argument
/// of its figure with further `curves`.
nlohmann::json record_json(const DesignRecord& run, const std::vector<rough::Target>& targets,
                           const std::string& curves);
/// The folder of a design, for any genome.
OutputFolder design_folder(const Settings& settings, bool resume);
/// Prints the verdict of a design that was finished before, and returns its exit code.
int repeat_verdict(const std::filesystem::path& result);

/// Runs `work(output, interrupt)` in the folder of a design, with its checkpoints. Then draws the page,
/// prints the summary and returns the exit code. If the design was finished, only prints the verdict.
template <class Run, class Work>
int run_in_folder(const char* kind, const std::string& line, const Settings& settings, Run& run, Work work) {
    run.origin = {kind, line, run.options.seed, ga::thread_count(run.options.threads), inputs_json(settings.files())};
    const bool resume = resumes(settings);
    const OutputFolder output = design_folder(settings, resume);
    const std::filesystem::path& folder = output.path();
    if (resume && says_finished(folder, "checkpoint.cbor", run.origin.inputs))
        return repeat_verdict(folder / "result.json");
    const double limit = run.options.seconds;
    const Interrupt interrupt;
    run.options.stop = &interrupt.flag();
    run.options.checkpoints = {folder / "checkpoint.cbor", resume,
                               [&](auto& keeper) { keeper.keep("stages", run.stages); }, checkpoint_interval(),
                               key_of(run.origin.inputs)};
    work(output, interrupt);
    if (settings.choice("pictures") == 0) {
        constexpr double min_seconds = 3;
        const double seconds = std::clamp(limit - run.clock.seconds(), min_seconds, run.interrupted ? 10. : 3600.);
        rough::write_atomically(folder / "report.html", render(page_source(folder), {.seconds = seconds}));
    }
    if (!run.interrupted && (run.found.stopped.empty() || run.summary.found))
        for (const char* kept : {"checkpoint.cbor", "checkpoint.cbor.before", "tolerance.cbor"})
            std::filesystem::remove(ga::held_path(folder / kept));
    tell_notes(run.found.notes);
    for (const Fact& fact : run.summary.facts)
        if (!fact.text.empty()) say(fact.name + ": " + fact.text);
    say(folder.string() + ": " + run.summary.verdict + " (" + readable(run.clock.seconds()) + " s)" +
        (std::filesystem::exists(folder / "checkpoint.cbor") ? "; --resume continues it" : "") +
        (std::filesystem::exists(folder / "report.html") ? "; page " + (folder / "report.html").string() : ""));
    return run.interrupted ? exit_interrupted : run.summary.found ? 0 : 3;
}

/// The parameters of a search that the program and Python share: everything except targets and files.
std::vector<Setting> search_settings();
/// All settings of the program's design: with target or scan, production and files.
std::vector<Setting> design_settings();

/// The request of --target or --like. Throws rough::InputError.
DesignRequest request_from(const Settings& settings);
/// A design with the response of a measured surface as target. With a resolution, the targets have a band.
rough::DesignSetup setup_like(const rough::Profile& surface, const rough::Model& model, const std::string& name,
                              const Settings& settings, rough::Resolution resolution = rough::Resolution::off);
/// The run of a request since `clock` began, after the exact tests of its targets. Throws rough::InputError.
DesignRun design_from(const Settings& settings, DesignRequest request, const ga::Stopwatch& clock = {});

/// Whether an answer has the required similarity, verified, within the limits, and no target is out of reach.
bool is_found(const DesignRun& run);
/// The summary of a run whose answer was found.
Summary summary_of(const DesignRun& run);
/// The quantities of a scan's response that were not requested, and how far the genome's are off at most.
Shares unrequested_errors(const rough::DesignSetup& design, const rough::Genome& genome);

/// Writes result.json, and tolerance.csv if the tolerance is known.
void write_design_result(const DesignRun& run, const std::filesystem::path& folder);
/// Writes answer.csv, the curve of the answer, genome.json, and a solid to print for a map.
void write_design_tables(const DesignRun& run, const std::filesystem::path& folder);
/// Writes the tables that the page's figures draw: curves.csv, points.csv, heights-drawn.csv or map.csv, and
/// front.csv or made.csv.
void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder);

/// The settings that only `rugosa design` with caps has.
std::vector<Setting> asperity_settings();
/// `rugosa design --asperities`: a design with spherical caps, from settings to files. Returns the exit code.
int design_asperities(const Settings& settings, const std::string& line);

} // namespace app
