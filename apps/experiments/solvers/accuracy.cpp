#include "apps/experiments/solvers/accuracy.hpp"

#include "apps/experiments/solvers/trial.hpp"
#include "apps/prompt/goals.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/result.hpp"
#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/design/error_budget.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"
#include "ga/base/stopwatch.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace app {

namespace {

/// Medians over the random surfaces of a kind.
Csv medians_table(const AccuracyRun& run) {
    std::map<std::tuple<std::string, std::string, std::string, double>, std::vector<SavingRow>> groups;
    for (const SavingRow& row : run.savings)
        groups[{row.kernel, row.surface, row.load, row.accuracy}].push_back(row);
    Csv table("kernel,surface,load,accuracy,milliseconds,saving", 6);
    for (const auto& [group, rows] : groups) {
        std::vector<double> seconds, savings;
        for (const SavingRow& row : rows)
            seconds.push_back(row.seconds), savings.push_back(row.saving());
        const auto& [kernel, surface, load, accuracy] = group;
        table.row(kernel, surface, load, accuracy, 1e3 * rough::median(seconds), rough::median(savings));
    }
    return table;
}

/// Errors against their estimates and limits, for each accuracy.
Csv coverage_table(const AccuracyRun& run) {
    std::map<double, std::vector<SavingRow>, std::greater<>> by_accuracy;
    for (const SavingRow& row : run.savings)
        by_accuracy[row.accuracy].push_back(row);
    Csv table("accuracy,scenes,covered,within,worst_over_accuracy,median_saving");
    for (const auto& [accuracy, rows] : by_accuracy) {
        double covered = 0, within = 0, worst = 0;
        std::vector<double> savings;
        for (const SavingRow& row : rows) {
            covered += row.covered();
            within += row.true_error <= accuracy;
            worst = std::max(worst, row.true_error / accuracy);
            savings.push_back(row.saving());
        }
        const auto scenes = static_cast<double>(rows.size());
        table.row(accuracy, rows.size(), covered / scenes, within / scenes, worst, rough::median(savings));
    }
    return table;
}

/// Each accuracy on one surface.
void add_savings(AccuracyRun& run, SavingRow row, const rough::Genome& genome, const rough::Model& model,
                 const std::vector<double>& accuracies) {
    rough::AccountedResponse exact, cheap;
    row.resolved_seconds = least_seconds([&] { exact = respond_exactly(genome, model); }, 2, HUGE_VAL);
    row.resolved_nodes = model.grid.nodes;
    for (const double accuracy : accuracies) {
        row.accuracy = accuracy;
        row.seconds = least_seconds([&] { cheap = respond_within(genome, model, accuracy); }, 2, HUGE_VAL);
        // Both curves have the error that their solvers' certificates allow.
        row.estimated_error = cheap.account.estimated_error + exact.account.estimated_error;
        row.true_error = rough::relative_error(cheap.response.pressure, exact.response.pressure);
        row.nodes = cheap.account.grids.back();
        row.dropped = cheap.account.dropped.size();
        run.savings.push_back(row);
    }
}

/// Random surfaces of each kind on each body under each load.
void try_accuracies(AccuracyRun& run, const Settings& settings, const Conditions& conditions) {
    const long samples = settings.whole("accuracy.surfaces");
    const std::vector<double> accuracies = settings.numbers("accuracy.accuracies");
    if (accuracies.empty())
        throw rough::InputError(settings.place("accuracy.accuracies") +
                                ": the list is empty; give numbers separated by commas");
    const double light = settings.number("accuracy.light");
    for (const std::string kind : {"smooth", "rough"})
        for (const rough::Kernel kernel : {rough::Kernel::free, rough::Kernel::strip})
            for (const std::string load : {"light", "full"})
                for (long sample = 0; sample < samples && !conditions.stop; ++sample) {
                    conditions.progress.show(kind + ", " + name_of(kernel) + ", " + load + " load");
                    rough::Model model = rough::exactly(run.setup.model);
                    model.body.kernel = kernel;
                    model.loading.reach = load == "light" ? light : 1;
                    const double H = settings.number("accuracy." + kind + "-H"), length = model.grid.length;
                    ga::Stream random(
                        ga::fold(ga::fold(run.origin.seed, kind), static_cast<std::uint64_t>(sample)));
                    const rough::Genome genome = rough::random_genome(
                        [&](double from, double to) { return random.uniform(from, to); }, 1, 1, length,
                        length / settings.number("accuracy." + kind + "-waves"),
                        {.A_from = 1, .A_to = 1, .H_from = H, .H_to = H});
                    model.grid = rough::resolved_grid(genome, length, false);
                    add_savings(run, {kind, name_of(kernel), load, static_cast<int>(sample)}, genome, model,
                                accuracies);
                }
}

void design(AccuracyRun& run, const Settings& settings, const Conditions& conditions) {
    conditions.progress.show("a designed surface");
    rough::SearchOptions options;
    options.seed = run.origin.seed;
    options.threads = run.origin.threads;
    options.evaluations = settings.whole("accuracy.design-budget");
    options.stop = &conditions.stop;
    std::vector<StageRecord> stages;
    const ga::Stopwatch clock;
    const rough::SearchResult found = rough::search(run.setup, options, {recorder(stages)});
    run.design = variant_run(found.name, found, std::move(stages), clock.seconds());
    run.design.answer.response =
        respond(run.setup, found.best.genome, rough::exactly(run.setup.model)).responses.front();
    run.budget = error_budget(run.setup, found.best);
}

Findings run_accuracy(const Settings& settings, const Conditions& conditions) {
    AccuracyRun run;
    run.origin = conditions.origin;
    run.setup.model = model_from(settings, "model.");
    run.setup.model.accuracy = accuracy_from(settings, "model.");
    run.setup.targets = {rough::read_target(target_files(settings, "targets.files").front())};
    run.setup.max_pressure = settings.number("targets.max-pressure");
    const ga::Stopwatch clock;
    try_accuracies(run, settings, conditions);
    if (!conditions.stop)
        design(run, settings, conditions);
    run.seconds = clock.seconds();
    return findings_of(run);
}

} // namespace

Findings findings_of(const AccuracyRun& run) {
    const rough::DesignSetup& setup = run.setup;
    Record record{run.origin,         setup.model,           loaded_models(setup),
                  setup.max_pressure, setup.targets.front(), {}};
    if (!run.design.name.empty())
        record.variants.push_back(run.design);
    Csv savings("surface,kernel,load,sample,accuracy,seconds,resolved_seconds,estimated_error,true_error,"
                "nodes,resolved_nodes,dropped_chromosomes");
    for (const SavingRow& row : run.savings)
        savings.row(row.surface, row.kernel, row.load, row.sample, row.accuracy, row.seconds,
                    row.resolved_seconds, row.estimated_error, row.true_error, row.nodes, row.resolved_nodes,
                    row.dropped);
    Csv budget("kind,source,size");
    for (const rough::ErrorSource& row : run.budget)
        budget.row(row.kind, row.source, row.size);
    nlohmann::json result = result_json(record);
    result.update({{"seconds", run.seconds}, {"savings", savings.rows()}, {"error_budget", budget.rows()}});
    return {.result = result,
            .files = {{"savings.csv", savings.text()},
                      {"medians.csv", medians_table(run).text()},
                      {"coverage.csv", coverage_table(run).text()},
                      {"budget.csv", budget.text()}}};
}

Experiment accuracy_experiment() {
    return {
        .kind = "accuracy",
        .summary = "time of curves within an accuracy, and the error budget of a designed surface",
        .settings = joined(
            {{Setting(ga::number("accuracy.accuracies", "3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4", ga::above_zero,
                                 1, "accuracies to try, separated by commas"))
                  .several(),
              ga::whole("accuracy.surfaces", "5", 1, "random surfaces of each kind").up_to(1000),
              ga::number("accuracy.smooth-H", "1.4", 0.01, 3, "H of the smooth surfaces"),
              ga::number("accuracy.rough-H", "0.6", 0.01, 3, "H of the rough ones"),
              ga::number("accuracy.smooth-waves", "16", 1, 1000,
                         "the smooth ones' shortest wave is the length over this"),
              ga::number("accuracy.rough-waves", "64", 1, 1000, "the rough ones'"),
              ga::number("accuracy.light", "0.1", 1e-3, 1, "reach of the light load; the full one's is 1"),
              ga::whole("accuracy.design-budget", "1500", 10, "curves and gradients for the designed surface")
                  .up_to(1e9),
              {"targets.files", "", "target curve (CSV) of the design"},
              pressure("targets.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa")},
             model_settings("model."),
             {accuracy_setting("model.")}}),
        .files = {"savings.csv", "medians.csv", "coverage.csv", "budget.csv"},
        .run = run_accuracy};
}

} // namespace app
