#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/design/run.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/json.hpp"
#include "ga/observers/progress.hpp"

namespace rough {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceLevel, similarity, noise_rms, tilt, scale)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NoiseQuantile, noise_rms, quantile, median, draws)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Tolerance, noise_length, similarity, draws, share_from, share_to, levels, curve,
                                   complete)
} // namespace rough

namespace app {

OutputFolder design_folder(const Settings& settings, bool resume) {
    const std::string names =
        "result.json,genome.json,answer.csv,report.html,checkpoint.cbor,"
        "checkpoint.cbor.before,tolerance.cbor,surface.stl,surface.3mf,surface.png,surface-scale.json,"
        "curves.csv,points.csv,heights-drawn.csv,map.csv,front.csv,made.csv,"
        "tolerance.csv,asperities.csv,spots.csv,tile.stl,tile.3mf,mould.stl,mould.3mf";
    return {settings.text("out"), "design", {rough::listed(names), settings.files(), settings.is_on("force"), resume}};
}

int repeat_verdict(const std::filesystem::path& result) {
    const auto before = rough::parsed_json(rough::read_whole(result), result.string());
    const nlohmann::json::json_pointer found("/summary/found"), verdict("/verdict");
    if (!before.contains(verdict) || !before.at(verdict).is_string() || !before.contains(found) ||
        !before.at(found).is_boolean())
        rough::refuse(result.string(), ": has no verdict; start again with --force");
    say(before.at(verdict).get<std::string>());
    return before.at(found) ? 0 : 3;
}

namespace {

/// Shares of --seconds after which the search, the tolerance (planned for a tenth) and the further checks of
/// the answer end. The rest is for drawing the report.
constexpr double searched_by = 0.75, tolerance_by = 0.86, checked_by = 0.9;

/// Searches for a surface or, in production, morphs one. The whole time of the run is `limit` (s).
void find_answer(DesignRun& run, double limit, ProgressLine& progress) {
    if (run.from) {
        const Production& from = *run.from;
        run.morphed =
            rough::morph(run.setup, from.genome, from.control, from.largest_change, run.setup.required_similarity);
        run.found = as_found(run.setup, *run.morphed);
        run.found.name = run.found.pipeline = "morph";
    } else {
        rough::SearchOptions options = run.options;
        options.seconds = searched_by * limit - run.clock.seconds();
        const auto evaluator = design_evaluator(options.threads);
        options.evaluator = evaluator.get();
        const auto show = [&](const std::string& text) { progress.show(text); };
        run.found = rough::search(run.setup, options, {recorder(run.stages), ga::progress<rough::Genome>(show)});
    }
    const rough::Answer& best = run.found.best;
    const rough::Grid& grid = run.setup.model.grid;
    run.response = response_of(run.setup, best);
    run.margins = margins(best.genome, grid, run.setup.limits);
    if (!grid.is_2d() || (best.is_verified() && !run.options.stop->load()))
        run.unrequested_errors = unrequested_errors(run.setup, best.genome);
}

/// The tolerance from the file of an interrupted run with the same answer and the same number of draws, or
/// else computed. If that did not depend on the time, it is stored.
rough::Tolerance kept_tolerance(const DesignRun& run, const rough::DesignSetup& setup,
                                const std::filesystem::path& file, const rough::ToleranceOptions& options) {
    const rough::Genome& genome = run.found.best.genome;
    const std::string key =
        rough::json_text({run.origin.inputs, rough::description(setup), rough::genome_to_json(genome), run.options.seed,
                          options.price, options.draws ? nlohmann::json(*options.draws) : nullptr},
                         true);
    if (run.options.checkpoints->resume && std::filesystem::exists(ga::held_path(file))) try {
            const nlohmann::json kept = ga::read_cbor(ga::opened(file), file);
            auto tolerance = kept.at("tolerance").get<rough::Tolerance>();
            if (kept.at("key") == key && !tolerance.levels.empty()) return tolerance;
        } catch (const ga::UsageError&) { // damaged: computed again
        } catch (const nlohmann::json::exception&) {
        }
    const rough::Tolerance tolerance = tolerance_of(setup, genome, options);
    const auto bytes = nlohmann::json::to_cbor({{"key", key}, {"tolerance", tolerance}});
    if (tolerance.complete && !tolerance.shortened) // without the file a resumed run computes it again
        ga::seal(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return tolerance;
}

/// Checks the answer of a run whose whole time is `limit` (s).
void check_answer(DesignRun& run, double limit, const std::filesystem::path& folder, ProgressLine& progress) {
    const rough::Answer& best = run.found.best;
    const rough::DesignSetup tried = toleranced(run);
    rough::ToleranceOptions tolerance = priced_tolerance(run, tried);
    rough::TrustOptions trust = run.trust_options;
    tolerance.stop = trust.stop = run.options.stop;
    progress.show("tolerance");
    tolerance.seconds = tolerance_by * limit - run.clock.seconds();
    run.tolerance = kept_tolerance(run, tried, folder / "tolerance.cbor", tolerance);
    progress.show("verifying");
    trust.seconds = checked_by * limit - run.clock.seconds();
    run.trust = trust_in(run.setup, best.genome, trust, &best, &run.response);
}

int design(const Settings& settings, const std::string& line) {
    if (settings.has("asperities")) return design_asperities(settings, line);
    expect_none(settings, names_of(asperity_settings()), "given without --asperities; give both or none");
    const ga::Stopwatch clock;
    DesignRun run = design_from(settings, request_from(settings), clock);
    const auto work = [&](const OutputFolder& output, const Interrupt& interrupt) {
        if (!run.from) rough::expect_searchable(run.setup, run.options.pipeline);
        std::ranges::for_each(run.accounts, say);
        if (!run.from) {
            rough::DesignSetup asked = run.setup;
            asked.model.contact.stop = rough::ending_after(0.05 * run.options.seconds, run.options.stop);
            for (const std::string& doubt : rough::doubts(asked)) say("note: " + doubt);
        }
        say_unreachable(run.unreachable, run.setup.model.grid.is_2d() ? "every map" : "every profile");
        ProgressLine progress;
        const double limit = run.options.seconds;
        const auto record = [&](const std::filesystem::path& to) {
            run.interrupted = interrupt.requested();
            run.found.stopped = stop_reason(run.found.stopped, run.interrupted);
            run.summary = summary_of(run);
            run.seconds = run.clock.seconds();
            write_design_result(run, to);
        };
        find_answer(run, limit, progress);
        record(output.restored());
        write_design_tables(run, output.path());
        if (!run.interrupted) {
            check_answer(run, limit, output.path(), progress);
            record(output.path());
        }
        if (settings.choice("pictures") == 0) try {
                write_design_drawings(run, output.path());
            } catch (const rough::InputError& error) { // the page has no pictures then
                say(std::string("note: ") + error.what());
            }
        if (run.trust) {
            for (const auto& flag : run.trust->flags) say("note: " + flag);
            if (!run.trust->left_out.empty())
                say("note: no time was left for " + std::to_string(run.trust->left_out.size()) +
                    " checks of the answer, which result.json names under trust");
        }
    };
    return run_in_folder("design", line, settings, run, work);
}

} // namespace

Command design_command() { return {"design", design_settings(), design}; }

} // namespace app
