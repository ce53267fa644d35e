#include "apps/commands.hpp"
#include "apps/csv.hpp"
#include "apps/design/page.hpp"
#include "apps/design/schedule.hpp"
#include "apps/design/settings.hpp"
#include "apps/interrupt.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/recorder.hpp"
#include "apps/result.hpp"
#include "apps/units.hpp"
#include "apps/voice.hpp"
#include "domain/atomic_file.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"
#include "ga/checkpoint.hpp"
#include "ga/parallel.hpp"

#include <cmath>

namespace app {

namespace {

using nlohmann::json;

json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(); }

json goal_json(const rough::Goal& goal) {
    const rough::Columns columns = columns_of(goal.quantity);
    json points = json::array();
    for (rough::Index k = 0; k < goal.points(); ++k) {
        json point = {{columns.x, goal.x[k]}, {columns.y, goal.y[k]}};
        if (goal.has_band())
            point["lower"] = goal.lower[k], point["upper"] = goal.upper[k];
        points.push_back(std::move(point));
    }
    return {{"name", goal.name}, {"weight", goal.weight}, {"points", std::move(points)}};
}

json answer_json(const rough::Answer& answer) {
    return {{"similarity", answer.similarity},
            {"similarity_refined", answer.similarity_refined},
            {"difference", answer.difference},
            {"genome", rough::genome_to_json(answer.genome)}};
}

json checks_json(const std::vector<rough::Check>& checks) {
    json all = json::array();
    for (const auto& check : checks)
        all.push_back({{"name", check.name}, {"similarity", number_or_null(check.similarity)}});
    return all;
}

json trust_json(const rough::Trust& trust) {
    return {{"checks", checks_json(trust.checks)},
            {"median", number_or_null(trust.median)},
            {"tenth_percentile", number_or_null(trust.tenth)},
            {"other_kernels", checks_json(trust.kernels)},
            {"phases_redrawn",
             {{"draws", trust.redrawn},
              {"best", number_or_null(trust.redrawn_best)},
              {"median", number_or_null(trust.redrawn_median)},
              {"tenth_percentile", number_or_null(trust.redrawn_tenth)}}},
            {"rms_slope", trust.rms_slope},
            {"peak_pressure_MPa", trust.peak_pressure},
            {"shortest_wave_nodes", trust.shortest_wave_nodes},
            {"contact_at_ends", trust.contact_at_ends},
            {"flags", trust.flags},
            {"left_out_for_time", trust.left_out}};
}

/// Similarities in the order of `targets`.
json front_json(const std::vector<rough::Compromise>& front) {
    json all = json::array();
    for (const auto& one : front)
        all.push_back({{"similarity", one.similarity},
                       {"similarity_refined", one.similarity_refined},
                       {"genome", rough::genome_to_json(one.genome)}});
    return all;
}

json design_json(const DesignRun& run) {
    json result = head_json(run.searched.model, {run.version, run.command, run.options.seed,
                                                 ga::thread_count(run.options.threads)});
    result["max_pressure_MPa"] = run.setup.max_pressure ? json(*run.setup.max_pressure) : json();
    result["target"] = goal_json(run.setup.goals.front());
    for (const rough::Goal& goal : run.setup.goals)
        result["targets"].push_back(goal_json(goal));
    result["verdict"] = run.verdict;
    result["interrupted"] = run.interrupted;
    result["out_of_reach"] = json::array();
    for (const auto& reason : run.out_of_reach)
        result["out_of_reach"].push_back(
            {{"reason", reason.reason}, {"at", reason.at}, {"highest_similarity", reason.bound}});

    VariantRun variant = variant_run(run.options.variant, run.found, run.stages, run.seconds);
    variant.answer.response = respond(run.setup, run.found.best.genome, run.setup.model).responses.front();
    json answer = variant_json(variant, loaded_models(run.searched));
    answer["pipeline"] = run.found.pipeline;
    answer["stopped"] = run.found.stopped;
    answer["alternatives"] = json::array();
    for (const auto& alternative : run.found.alternatives)
        answer["alternatives"].push_back(answer_json(alternative));
    if (!run.found.front.empty())
        answer["front"] = front_json(run.found.front);
    answer["margins"] = json::array();
    for (const auto& margin : run.margins)
        answer["margins"].push_back({{"name", margin.name},
                                     {"limit", margin.limit > 0 ? json(margin.limit) : json()},
                                     {"value", margin.value},
                                     {"margin", margin.limit > 0 ? json(margin.margin()) : json()},
                                     {"holds", margin.holds()}});
    answer["within_limits"] = run.found.best.within_limits;
    if (run.trust)
        answer["trust"] = trust_json(*run.trust);
    result["variants"][run.options.variant] = std::move(answer);
    return result;
}

void write_result(const DesignRun& run, const std::filesystem::path& folder) {
    rough::write_atomically(folder / "result.json", design_json(run).dump(1) + "\n");
}

/// The answer's own curve on both grids beside the files' usual columns.
void write_tables(const DesignRun& run, const std::filesystem::path& folder) {
    const auto coarse = respond(run.setup, run.found.best.genome, run.setup.model);
    rough::write_atomically(folder / "answer.csv", csv(coarse.responses.front()));
    rough::write_atomically(folder / "genome.json",
                            rough::genome_file_text(run.found.best.genome, run.setup.model.grid.length));
}

int exit_code(const DesignRun& run) {
    if (run.interrupted)
        return exit_interrupted;
    const bool missed = run.options.reach && run.found.best.judged() < *run.options.reach;
    return missed || !run.out_of_reach.empty() || !run.found.best.within_limits ? 3 : 0;
}

} // namespace

std::string verdict_of(const DesignRun& run) {
    const double judged = run.found.best.judged();
    std::string line;
    if (!run.out_of_reach.empty())
        line = "out of reach of every profile: " + run.out_of_reach.front().reason +
               "; no similarity is above " + readable(run.bound, 4) + ", the nearest found has " +
               readable(judged, 4);
    else if (judged >= run.wanted)
        line = "found: similarity " + readable(judged, 5) + " on both grids";
    else
        line = "not found within the budget: the nearest curve has similarity " + readable(judged, 4) +
               ", wanted is " + readable(run.wanted, 4);
    if (!run.found.best.within_limits)
        line += "; no answer holds every limit";
    return line;
}

int design(const Words& words) {
    const ga::Stopwatch clock;
    if (shows_help(
            words, "design (--target T.csv | --like SCAN.txt [--unit U]) [flags]",
            "Finds a rough profile that answers as the target asks, and says what to believe of it. Writes\n"
            "result.json, genome.json, answer.csv and report.html to a folder. A target is a CSV file with "
            "the\n"
            "columns pressure_MPa and stiffness_MPa_per_mm, contact_fraction or conductance, or "
            "displacement_mm\n"
            "and contact_fraction or pressure_MPa; columns lower and upper give a tolerance band.\n"
            "Exit codes: 0 done; 2 wrong use; 3 similarity or limits missed, or the target is out of reach; "
            "130\n"
            "interrupted. The best so far is written in every case but wrong use.",
            design_settings(),
            {"design --target target.csv", "design --target target.csv --max-pressure 1.6e-4 --seconds 5",
             "design --like scan.txt --unit um --reach-similarity 0.99",
             "design --target target.csv --database genomes.db --seconds 1",
             "design --target stiffness.csv,area.csv --weights 1,0.3",
             "design --target stiffness.csv,area.csv --variant nsga2",
             "design --target target.csv --largest-slope 0.05 --smallest-radius 0.01",
             "design --target target.csv --pipeline \"sample 200 | score | best 20 | refine lm 40 | best "
             "1\""}))
        return 0;
    const Settings settings = read_command_line(words, design_settings());
    DesignRun run = design_from(settings);
    run.version = RUGOSA_VERSION;
    run.command = command_line("design", words);
    const bool resume = settings.is_on("resume");
    if (resume && !settings.has("out"))
        throw rough::InputError(
            "--resume: given without --out, expected the folder of the design to go on with");
    const OutputFolder output(settings.text("out"), "design", settings.is_on("force") || resume);
    const auto& folder = output.path();
    const bool pictures = settings.one_of("pictures", {"on", "off"}) == 0;
    for (const auto& account : run.accounts)
        say(account);

    const Interrupt interrupt;
    Progress progress;
    const Schedule schedule(clock, run.options.seconds, run.setup, run.options.threads, pictures);
    run.options.seconds = schedule.for_search();
    run.options.compared = schedule.compared();
    if (run.options.compared == 1)
        run.options.alternatives = 1; // there is hardly time for one
    run.options.stop = &interrupt.flag();
    const auto checkpoint = folder / "checkpoint.cbor";
    run.options.keeping =
        rough::Keeping{checkpoint, resume, [&](auto& keeper) { keeper.keep("stages", run.stages); }};
    if (!run.out_of_reach.empty())
        run.options.evaluations = 3000; // the nearest curve is enough
    double best = -HUGE_VAL;
    const auto report_progress = [&](const ga::Event<rough::Genome>& event) {
        for (const auto& individual : event.population)
            if (individual.fitness.known() && !individual.fitness.has_failed())
                best = std::max(best, individual.value());
        progress.show(event.path + ": " + std::to_string(event.counters.asked) + " curves, best " +
                      readable(best, 5));
    };
    run.found = rough::search(run.searched, run.options, {recorder(run.stages), report_progress});
    run.interrupted = interrupt.asked();
    run.margins = margins(run.found.best.genome, run.setup.model.grid, run.setup.limits);
    run.verdict = verdict_of(run);
    run.seconds = schedule.spent();
    if (run.found.stopped.empty() || (run.options.reach && run.found.best.judged() >= *run.options.reach))
        std::filesystem::remove(checkpoint);

    write_result(run, folder);
    write_tables(run, folder);
    if (!run.interrupted) {
        progress.show("verifying");
        run.trust_options.seconds = schedule.for_trust();
        if (run.trust_options.seconds > 0)
            run.trust = trust_in(run.setup, run.found.best.genome, run.trust_options);
        else
            run.found.notes.push_back("no time was left to verify the answer");
        run.seconds = schedule.spent();
        write_result(run, folder);
        if (pictures && schedule.has_time_for_page())
            rough::write_atomically(folder / "report.html", design_page(run));
        else if (pictures)
            say("note: no time was left for report.html; expected more --seconds for it");
    }
    if (run.trust)
        for (const auto& flag : run.trust->flags)
            say("note: " + flag);
    say(folder.string() + ": " + run.verdict + " (" + readable(schedule.spent()) + " s)" +
        (std::filesystem::exists(checkpoint) ? "; --resume goes on with the search" : ""));
    return exit_code(run);
}

} // namespace app
