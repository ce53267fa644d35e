#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/design/run.hpp"
#include "apps/report/output.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/progress.hpp"

#include <algorithm>

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
        run.interrupted = interrupt.asked();
        run.response = response_of(run.setup, run.found.best);
        if (!run.setup.model.grid.is_2d() || (run.found.best.is_verified() && !run.interrupted))
            run.not_asked = off_unasked(run);
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
            run.interrupted = interrupt.asked();
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

Command design_command() {
    return {"design",
            "design a rough surface that has a given contact behaviour",
            "(--target T.csv | --like SCAN.txt [--unit U]) [flags]",
            "Designs a rough surface whose response is that of the target, and verifies the answer. Writes "
            "result.json, genome.json, answer.csv and report.html to a folder, and for a map a tile to print "
            "(surface.3mf, surface.stl, surface.png). A target is a CSV file with the columns pressure_MPa "
            "and stiffness_MPa_per_mm, contact_fraction or conductance, or displacement_mm and "
            "contact_fraction or pressure_MPa. Columns lower and upper are a tolerance band. The answer is "
            "verified on its grid, on a grid four times finer, in four times the load steps, and in both. "
            "Its lowest similarity must be at least 0.99, or --reach-similarity. With --from a surface in "
            "production is corrected instead: the phases of the named chromosomes are changed as little as "
            "is necessary to meet the target again. Exit code 0: found. 2: wrong use. 3: similarity or "
            "limits missed, a map not verified in time, or the target is out of reach. 130: interrupted. The "
            "best answer is written, except after wrong use. With --asperities the surface is an array of "
            "spherical caps; asperities.csv has their heights.",
            design_settings(),
            {"design --target target.csv", "design --target target.csv --max-pressure 1.6e-4 --seconds 5",
             "design --like scan.txt --unit um --reach-similarity 0.99",
             "design --target target.csv --database genomes.db --seconds 1",
             "design --target stiffness.csv,area.csv --weights 1,0.3",
             "design --target stiffness.csv,area.csv --variant nsga2",
             "design --from genome.json --control 1:3,1:5 --largest-change 0.02 --target target.csv",
             "design --target target.csv --max-slope 0.05 --min-radius 0.01",
             "design --asperities 8x8 --pitch 1.5 --radius 0.526 --heights 0:0.12:0.001 --modulus 1.36 "
             "--target law.csv",
             "design --target target.csv --pipeline \"sample 200 | score | best 20 | refine lm 40 | best "
             "1\""},
            design};
}

} // namespace app
