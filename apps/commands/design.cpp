#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/design/run.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/observers/progress.hpp"

namespace app {

OutputFolder design_folder(const Settings& settings, bool resume) {
    const std::string names = "result.json,genome.json,answer.csv,report.html,checkpoint.cbor,"
                              "checkpoint.cbor.before,surface.stl,surface.3mf,surface.png,surface-scale.json,"
                              "curves.csv,points.csv,heights-drawn.csv,map.csv,front.csv,made.csv,"
                              "tolerance.csv,asperities.csv,spots.csv,tile.stl,tile.3mf,mould.stl,mould.3mf";
    return {settings.text("out"),
            "design",
            {rough::listed(names), settings.files(), settings.is_on("force"), resume}};
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

void write_page(const std::filesystem::path& folder, double seconds_left) {
    constexpr double min_seconds = 3;
    rough::write_atomically(
        folder / "report.html",
        render(page_source(folder), {.seconds = std::clamp(seconds_left, min_seconds, 3600.)}));
}

namespace {

/// Shares of --seconds after which the search, the tolerance (planned for a tenth) and the further checks of
/// the answer end. The rest is for drawing the report.
constexpr double searched_by = 0.75, tolerance_by = 0.86, checked_by = 0.9;

/// Finds the smallest change of the controlled phases that brings a surface back to its target.
void morph_into(DesignRun& run) {
    const Production& from = *run.from;
    run.morphed = rough::morph(run.searched, from.genome, from.control, from.largest_change,
                               run.searched.required_similarity);
    run.found = as_found(run.searched, *run.morphed);
    run.found.name = run.found.pipeline = "morph";
}

int design(const Settings& settings, const std::string& line) {
    if (settings.has("asperities"))
        return design_asperities(settings, line);
    expect_none(settings, names_of(asperity_settings()), "given without --asperities; give both or none");
    DesignRun run = design_from(settings);
    const auto work = [&](const OutputFolder& output, const Interrupt& interrupt) {
        const auto& folder = output.path();
        for (const auto& account : run.accounts)
            say(account);
        Progress progress;
        const double limit = run.options.seconds;
        run.options.seconds = searched_by * limit - run.clock.seconds();
        const auto evaluator = design_evaluator(run.options.threads);
        run.options.evaluator = evaluator.get();
        if (run.from)
            morph_into(run);
        else
            run.found = rough::search(
                run.searched, run.options,
                {recorder(run.stages),
                 ga::progress<rough::Genome>([&](const std::string& text) { progress.show(text); })});
        run.setup = exactly(run.found.setup);
        run.searched = run.found.setup;
        run.interrupted = interrupt.requested();
        run.response = response_of(run.setup, run.found.best);
        if (!run.setup.model.grid.is_2d() || (run.found.best.is_verified() && !run.interrupted))
            run.unrequested_errors = unrequested_errors(run);
        run.margins = margins(run.found.best.genome, run.setup.model.grid, run.setup.limits);
        const auto record = [&](const std::filesystem::path& to) {
            run.summary = summary_of(run);
            run.seconds = run.clock.seconds();
            write_design_result(run, to);
        };
        record(output.restored());
        write_design_tables(run, folder);
        if (!run.interrupted) {
            progress.show("tolerance");
            run.tolerance_options.seconds = tolerance_by * limit - run.clock.seconds();
            run.tolerance_options.stop = run.options.stop;
            run.tolerance = tolerance_of(run.setup, run.found.best.genome, run.tolerance_options);
            progress.show("verifying");
            run.trust_options.seconds = checked_by * limit - run.clock.seconds();
            run.trust_options.stop = run.options.stop;
            run.trust =
                trust_in(run.setup, run.found.best.genome, run.trust_options, &run.found.best, &run.response);
            run.interrupted = interrupt.requested();
            record(folder);
        }
        if (!run.interrupted && settings.choice("pictures") == 0)
            try {
                write_design_drawings(run, folder);
            } catch (const rough::InputError& error) { // the page has no pictures then
                say(std::string("note: ") + error.what());
            }
        if (run.trust) {
            for (const auto& flag : run.trust->flags)
                say("note: " + flag);
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
