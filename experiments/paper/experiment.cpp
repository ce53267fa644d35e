#include "apps/cluster/evaluator.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/output.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"
#include "experiments/paper/paper.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/log.hpp"

extern template class ga::Checkpoints<rough::DesignProblem>; // is in domain/design/search.cpp

namespace app {
namespace {

using rough::DesignProblem;
using rough::DominanceRule;

/// The keys whose values a run keeps as they are.
Bindings bindings_of(PaperRun& run) {
    rough::DatabaseLayout& layout = run.layout;
    return {
        {max_pressure_setting("paper.", "1.6e-4"), run.max_pressure},
        {ga::whole("database.pairs", "20", 1, "Sobol pairs (H, gamma)").up_to(100000), layout.pairs},
        {ga::whole("database.phase-columns", "5", 1, "Sobol phase columns").up_to(1000), layout.phase_columns},
        {positive("database.A", "1", "amplitude A"), layout.A},
        {positive("database.lambda", "", "longest wave, mm [L]"), layout.lambda},
        {positive("database.shortest-wave", "", "shortest wave, mm [the grid's spacing]"), layout.shortest},
    };
}

/// A measured profile's response as a target: K at 20 even pressures up to its last one.
rough::Target target_of(const Source& scan, const rough::Model& model, const std::string& name) {
    const rough::Response response = respond(scan.measured, model);
    const rough::Curve curve = secant_stiffness(response);
    rough::Target target;
    target.name = name;
    target.x.resize(20);
    for (rough::Index k = 0; k < 20; ++k) target.x[k] = curve.to * static_cast<double>(k + 1) / 20;
    target.y = target.x.unaryExpr([&](double p) { return curve.at(p); });
    return target;
}

/// The paper's targets contain only K. A recorded model would be ignored, so it is refused.
rough::Target stiffness_from(const std::string& file) {
    rough::Target target = rough::read_target(file);
    if (target.quantity != rough::Quantity::stiffness || target.has_band() || !target.recorded.empty())
        rough::refuse(file, ": has another quantity, a band or a recorded model; give only "
                            "pressure_MPa,stiffness_MPa_per_mm");
    return target;
}

/// The model and the targets.
void take_targets(const Settings& settings, PaperRun& run) {
    if (settings.has("target.profile")) {
        const Source scan = scan_from(settings.path("target.profile"), settings, 0, "target.");
        run.model = model_from(settings, scan, "model.");
        if (!settings.has("model.nodes")) run.model.grid.nodes = 512;
        run.targets = {{"measured", target_of(scan, run.model, settings.text("target.profile"))}};
        return;
    }
    if (!settings.has("target.file"))
        settings.refuse("target.file", "missing; name a target (CSV), or a measured profile as target.profile");
    run.model = model_from(settings, "model.");
    run.targets = {{"drawn", stiffness_from(settings.path("target.file"))}};
    if (settings.has("heldout.file"))
        run.targets.push_back({"held-out", stiffness_from(settings.path("heldout.file"))});
}

/// The sentence on each claim from a file like readings.json.
std::map<std::string, std::string> readings_from(const std::filesystem::path& file) {
    try {
        return rough::parsed_json(rough::read_whole(file), file.string()).at("claims");
    } catch (const nlohmann::json::exception&) {
        rough::refuse(file.string(), ": has no sentence on each claim; give a file like "
                                     "experiments/paper/readings.json");
    }
}

/// The keys of paper.ini.
std::vector<Setting> paper_settings() {
    const std::vector<Setting> settings{
        {"target.file", "", "target curve (CSV)"},
        {"target.profile", "", "measured profile whose response is the target, instead of target.file"},
        {"heldout.file", "", "second target curve (CSV)"},
        {"variants.*", "", "NAME = pipeline: further variants, as text (rugosa operators)"},
        ga::number("paper.threshold", "0.5", 0, 1, "p_bar over p_max"),
        ga::number("paper.sweep-from", "0.31", 0.01, 1, "first p_bar over p_max of the threshold sweep"),
        ga::number("paper.sweep-to", "0.69", 0.01, 1, "last p_bar over p_max of the sweep"),
        ga::whole("paper.sweep-points", "20", 0, "number of thresholds; 0: no sweep").up_to(1000),
        {"paper.readings", "", "file of sentences on the claims under other readings"},
    };
    PaperRun run;
    return joined({settings, settings_of(bindings_of(run)), settings_of(with_bounds({}, run.layout), "database."),
                   scan_settings("target."), model_settings("model.")});
}

/// The requested models, targets, database and seed; nothing is run. Throws rough::InputError.
PaperRun paper_from(const Settings& settings, const Origin& origin) {
    PaperRun run;
    run.origin = origin;
    take_targets(settings, run);
    run.layout.lambda = run.model.grid.length;
    run.layout.shortest = run.model.grid.spacing();
    take(settings, bindings_of(run));
    take(settings, with_bounds({}, run.layout), "database.");
    expect_in_order(settings, {"database.hurst", "database.gamma", "paper.sweep"});
    if (settings.has("target.profile")) run.max_pressure = run.targets[0].target.last();
    run.p_bar = settings.number("paper.threshold") * run.max_pressure;
    if (settings.has("paper.readings")) run.other_readings = readings_from(settings.path("paper.readings"));
    return run;
}

/// A pipeline with its name.
struct NamedPipeline {
    std::string name;
    rough::DesignPipeline pipeline;
};

/// Throws rough::InputError on a variant that draws genomes. Only phases move in the paper's problem, so it
/// has no shortest wavelength to draw them by.
void expect_no_draws(const Settings& settings, const NamedPipeline& variant) {
    const std::string text = "|" + variant.pipeline.text() + "|";
    for (std::size_t at = text.find("sample"); at != std::string::npos; at = text.find("sample", at + 1)) {
        const std::size_t before = text.find_last_not_of(' ', at - 1), end = text.find_first_of("|{}", at);
        if (text[before] == '|' || text[before] == '{')
            settings.refuse("variants." + variant.name,
                            "stage '" + std::string(rough::trim(text.substr(at, end - at))) +
                                "' draws genomes, but this run starts from its database; omit the stage");
    }
}

/// The paper's three in both forms, then what the experiment writes in [variants].
std::vector<NamedPipeline> variants_from(const Settings& settings, const rough::Vocabulary& words) {
    std::vector<std::string> names{"sog", "gco", "cco", "sog-minimax", "gco-minimax", "cco-minimax"};
    ga::Variants texts = rough::paper_variants();
    for (const auto& [name, text] : settings.texts_under("variants.")) {
        if (!texts.emplace(name, text).second)
            settings.refuse("variants." + name, "the paper has a variant of this name; choose another");
        names.push_back(name);
    }
    ga::Parser<DesignProblem> parser(paper_registry(words), texts);
    std::vector<NamedPipeline> variants;
    for (const std::string& name : names)
        variants.push_back({name, read_at(settings, "variants." + name, [&] { return parser.variant(name); })});
    for (const NamedPipeline& variant : variants) expect_no_draws(settings, variant);
    return variants;
}

/// A run of gco or cco at one threshold (MPa).
nlohmann::json threshold_row(const VariantRun& run, double p_bar) {
    const auto candidates = [&](const std::string& path) {
        const auto stage = std::ranges::find(run.stages, run.name + "/" + path, &StageRecord::path);
        return stage == run.stages.end() ? std::vector<Candidate>() : stage->candidates;
    };
    const auto children = rough::column(candidates("score.1"), &Candidate::similarity);
    const auto is_above = [](double similarity) { return similarity > 0.95; };
    const std::size_t U1 = candidates("pair.1/left/above.1").size(), U2 = candidates("pair.1/right/above.1").size();
    return {{"p_bar_MPa", p_bar},
            {"variant", run.name},
            {"U1", U1},
            {"U2", U2},
            {"U3", U1 * U2},
            {"at_least_used", !run.notes.empty()},
            {"children", children.size()},
            {"share_above", rough::mean(rough::column(children, is_above))},
            {"best_child", std::ranges::max(children)},
            {"parents", run.stages.back().candidates.front().parents},
            {"similarity", run.similarity}};
}

/// Each genome's scores on a target whose low part ends at p_bar.
std::vector<Scores> scores_of(const std::vector<Answered>& database, const rough::DesignSetup& setup) {
    const auto low = points_of_half(setup, false), high = points_of_half(setup, true);
    std::vector<Scores> scores;
    for (const Answered& one : database) {
        const Eigen::VectorXd misfits = misfit(setup.targets.front(), secant_stiffness(one.response));
        scores.push_back(
            {rough::similarity(misfits), rough::similarity(misfits(low)), rough::similarity(misfits(high))});
    }
    return scores;
}

/// The searches of one experiment, with the genomes and pipelines that all targets share.
class Paper {
  public:
    Paper(const Settings& settings, PaperRun& run, const RunConditions& conditions)
        : settings_(settings), run_(run), conditions_(conditions), genomes_(sobol_database(run.layout)),
          variants_(variants_from(settings, {std::make_shared<DominanceRule>(run.model)})) {
        conditions.progress.show("database");
        run.database = answered(genomes_, run.model, run.max_pressure, run.origin.threads);
    }

    void design(TargetRun& target) {
        const rough::DesignSetup setup = setup_for(target, run_.p_bar);
        const DesignProblem problem(setup);
        target.database = scores_of(run_.database, setup);
        for (const NamedPipeline& variant : variants_) {
            if (conditions_.stop) return;
            conditions_.progress.show(target.title + ": " + variant.name);
            VariantRun run;
            if (!read_at(settings_, "variants." + variant.name,
                         [&] { return run_with_files(run, variant, problem, target.title); }))
                continue;
            const auto verified = rough::Verifier(as_reported(setup)).of(run.answer.genome);
            run.similarity_refined = verified.refined;
            run.similarity_worst = verified.worst;
            target.variants.push_back(std::move(run));
        }
    }

    void sweep(TargetRun& target) {
        const double from = settings_.number("paper.sweep-from"), to = settings_.number("paper.sweep-to");
        const long count = settings_.whole("paper.sweep-points");
        for (long i = 0; i < count; ++i) {
            const double fraction =
                from + (to - from) * static_cast<double>(i) / static_cast<double>(std::max(count - 1, 1L));
            const DesignProblem problem(setup_for(target, fraction * run_.max_pressure), memory_);
            for (const std::size_t cross_over : {1u, 2u}) {
                if (conditions_.stop) return;
                conditions_.progress.show(target.title + ": threshold " + std::to_string(i + 1) + " of " +
                                          std::to_string(count));
                if (VariantRun run; run_into(run, variants_[cross_over], problem))
                    target.thresholds.push_back(threshold_row(run, fraction * run_.max_pressure));
            }
        }
    }

  private:
    rough::DesignSetup setup_for(const TargetRun& target, double p_bar) const {
        return paper_setup(run_.model, target.target, run_.max_pressure, p_bar);
    }

    /// Runs a variant and records its stages; its answer is solved exactly. Returns false if the run was
    /// stopped before a genome was scored.
    bool run_into(VariantRun& run, const NamedPipeline& variant, const DesignProblem& problem,
                  std::vector<ga::Observer<rough::Genome>> observers = {},
                  ga::Checkpointer<DesignProblem>* keeper = nullptr) const {
        ga::RunOptions options;
        options.variant = run.name = variant.name;
        options.seed = run_.origin.seed;
        options.threads = run_.origin.threads;
        options.budget.stop = &conditions_.stop;
        observers.insert(observers.begin(), recorder(run.stages));
        const auto result =
            ga::run_by(*evaluator_, variant.pipeline, problem, ga::population(genomes_), options, observers, keeper);
        if (result.population.empty()) return false;
        run.seconds = result.seconds;
        run.notes = result.notes;
        run.answer.genome = in_final_form(problem.setup(), result.population.front().genome);
        run.answer.response = respond(run.answer.genome, problem.setup().model);
        run.similarity = similarity(as_reported(problem.setup()), run.answer.genome);
        run.curves = result.counters.evaluations;
        run.gradients = result.counters.gradients;
        run.price = result.counters.price;
        return true;
    }

    /// Like run_into(), with a checkpoint and a log of every stage in the run's folder.
    bool run_with_files(VariantRun& run, const NamedPipeline& variant, const DesignProblem& problem,
                        const std::string& title) const {
        const std::string name = title + "-" + variant.name;
        std::error_code none; // without these folders the run continues
        for (const char* folder : {"checkpoints", "log"})
            std::filesystem::create_directories(ga::held_path(conditions_.folder / folder), none);
        ga::Log log(conditions_.folder / "log" / (name + ".csv"));
        ga::Checkpoints<DesignProblem> checkpoints(conditions_.folder / "checkpoints" / (name + ".cbor"),
                                                   RUGOSA_VERSION + key_of(run_.origin.inputs) +
                                                       rough::json_text(description(problem.setup()), true),
                                                   conditions_.resume, checkpoint_interval());
        checkpoints.keep("stages", run.stages);
        checkpoints.keep("log", log.position);
        const bool is_scored = run_into(run, variant, problem, {log.observer(problem)}, &checkpoints);
        log.close();
        tell_notes(run.notes);
        if (!log.trouble.empty()) tell_notes({log.trouble});
        return is_scored;
    }

    const Settings& settings_;
    PaperRun& run_;
    const RunConditions& conditions_;
    std::unique_ptr<ga::Evaluator<DesignProblem>> evaluator_ = design_evaluator(run_.origin.threads);
    std::shared_ptr<rough::ResponseMemory> memory_ = std::make_shared<rough::ResponseMemory>(); ///< for the sweep
    std::vector<rough::Genome> genomes_;
    std::vector<NamedPipeline> variants_;
};

Findings run_paper(const Settings& settings, const RunConditions& conditions) {
    const ga::Stopwatch clock;
    PaperRun run = paper_from(settings, conditions.origin);
    Paper paper(settings, run, conditions);
    for (TargetRun& target : run.targets) {
        paper.design(target);
        paper.sweep(target);
    }
    run.seconds = clock.seconds();
    conditions.progress.show("claims");
    return findings_of(run, studies_of(run));
}

} // namespace

std::vector<Answered> answered(const std::vector<rough::Genome>& genomes, const rough::Model& model,
                               double max_pressure, int threads) {
    std::vector<Answered> database(genomes.size());
    ga::parallel_for(genomes.size(), threads, [&](std::size_t i) {
        rough::Genome genome = genomes[i];
        rough::Response response = respond(genome, model);
        genome.scale = max_pressure / response.pressure[response.steps() - 1]; // Eq. 11
        database[i] = {genome, scaled(std::move(response), genome.scale)};
    });
    return database;
}

Experiment paper_experiment() {
    return {.kind = "paper",
            .settings = paper_settings(),
            .files = rough::listed("claims.csv, genomes.csv, database.csv, scores.csv, stages.csv, refinements.csv, "
                                   "convergence.csv, curves.csv, stiffness.csv, heights.csv, spectra.csv, lines.csv, "
                                   "target.csv, thresholds.csv, chromosomes.csv, ridges.csv, fractal-heights.csv, "
                                   "fractal-bands.csv, fractal-curves.csv, heldout, log"),
            .run = run_paper,
            .resumes = true};
}

} // namespace app
