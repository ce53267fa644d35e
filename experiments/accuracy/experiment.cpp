#include "apps/experiments/experiment.hpp"

#include "apps/experiments/trial.hpp"
#include "apps/prompt/model_settings.hpp"
#include "domain/mwm/response.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"

namespace app {

namespace {

using nlohmann::json;

/// Medians over the random surfaces of a kind; errors against estimates and limits for each accuracy.
void add_medians(Findings& found, const json& savings) {
    std::map<json, std::vector<json>> groups;
    std::map<double, std::vector<json>, std::greater<>> by_accuracy;
    for (const json& row : savings) {
        groups[{row["kernel"], row["surface"], row["load"], row["accuracy"]}].push_back(row);
        by_accuracy[row["accuracy"]].push_back(row);
    }
    const auto over = [](const std::vector<json>& rows, const char* of, const char* by) {
        return rough::column(rows, [&](const json& row) { return row[of].get<double>() / row[by].get<double>(); });
    };
    Csv& medians = found.table("medians.csv", "kernel,surface,load,accuracy,milliseconds,saving", 6);
    for (const auto& [group, rows] : groups) {
        const auto seconds = rough::column(rows, [](const json& row) { return row["seconds"].get<double>(); });
        medians.row(group[0], group[1], group[2], group[3], 1e3 * rough::median(seconds),
                    rough::median(over(rows, "resolved_seconds", "seconds")));
    }
    Csv& coverage = found.table("coverage.csv", "accuracy,scenes,covered,within,worst_over_accuracy,median_saving");
    for (const auto& [accuracy, rows] : by_accuracy) {
        const auto errors = over(rows, "true_error", "accuracy");
        const auto covered =
            rough::column(rows, [](const json& row) { return row["true_error"] <= row["estimated_error"]; });
        coverage.row(accuracy, rows.size(), rough::mean(covered), rough::share_up_to(errors, 1),
                     std::ranges::max(errors), rough::median(over(rows, "resolved_seconds", "seconds")));
    }
}

/// Adds the time and the error of each accuracy for random surfaces of each kind, body and load.
void try_accuracies(Csv& savings, const rough::Model& base, const Settings& settings, const RunConditions& conditions) {
    const long samples = settings.whole("accuracy.surfaces");
    const std::vector<double> accuracies = settings.numbers("accuracy.accuracies");
    if (accuracies.empty())
        settings.refuse("accuracy.accuracies", "the list is empty; give numbers separated by commas");
    const double light = settings.number("accuracy.light");
    for (const std::string kind : {"smooth", "rough"})
        for (const rough::Kernel kernel : {rough::Kernel::free, rough::Kernel::strip})
            for (const std::string load : {"light", "full"})
                for (long sample = 0; sample < samples && !conditions.stop; ++sample) {
                    conditions.progress.show(kind + ", " + name_of(kernel) + ", " + load + " load");
                    rough::Model model = base;
                    model.body.kernel = kernel;
                    model.loading.reach = load == "light" ? light : 1;
                    const double H = settings.number("accuracy." + kind + "-H"), length = model.grid.length;
                    ga::Stream random(
                        ga::fold(ga::fold(conditions.origin.seed, kind), static_cast<std::uint64_t>(sample)));
                    const rough::Genome genome =
                        rough::random_genome([&](double from, double to) { return random.uniform(from, to); }, 1, 1,
                                             length, length / settings.number("accuracy." + kind + "-waves"),
                                             {.A_from = 1, .A_to = 1, .H_from = H, .H_to = H});
                    model.grid = rough::resolved_grid(genome, length, false);
                    rough::ReportedResponse exact, cheap;
                    const double resolved = lowest_seconds([&] { exact = respond_within(genome, model); }, 2, HUGE_VAL);
                    for (const double accuracy : accuracies) {
                        rough::Model within = model;
                        within.accuracy = accuracy;
                        const double seconds =
                            lowest_seconds([&] { cheap = respond_within(genome, within); }, 2, HUGE_VAL);
                        // Both curves have the error that their solvers' certificates allow.
                        savings.row(kind, name_of(kernel), load, sample, accuracy, seconds, resolved,
                                    cheap.account.estimated_error + exact.account.estimated_error,
                                    rough::relative_error(cheap.response.pressure, exact.response.pressure),
                                    cheap.account.grids.back(), model.grid.nodes, cheap.account.dropped.size());
                    }
                }
}

Findings run_accuracy(const Settings& settings, const RunConditions& conditions) {
    const ga::Stopwatch clock;
    const rough::Model model = model_from(settings, "model.");
    Findings found;
    Csv& savings = found.table("savings.csv", "surface,kernel,load,sample,accuracy,seconds,resolved_seconds,"
                                              "estimated_error,true_error,nodes,resolved_nodes,"
                                              "dropped_chromosomes");
    try_accuracies(savings, model, settings, conditions);
    add_medians(found, savings.rows());
    found.result = model_json(model);
    found.result.update({{"seconds", clock.seconds()}, {"savings", savings.rows()}});
    return found;
}

} // namespace

Experiment accuracy_experiment() {
    return {.kind = "accuracy",
            .settings =
                joined({{Setting(ga::number("accuracy.accuracies", "3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4", ga::above_zero,
                                            1, "accuracies to try, separated by commas"))
                             .several(),
                         ga::whole("accuracy.surfaces", "5", 1, "random surfaces of each kind").up_to(1000),
                         ga::number("accuracy.smooth-H", "1.4", 0.01, 3, "H of the smooth surfaces"),
                         ga::number("accuracy.rough-H", "0.6", 0.01, 3, "H of the rough ones"),
                         ga::number("accuracy.smooth-waves", "16", 1, 1000,
                                    "the smooth ones' shortest wave is the length over this"),
                         ga::number("accuracy.rough-waves", "64", 1, 1000, "the rough ones'"),
                         ga::number("accuracy.light", "0.1", 1e-3, 1, "reach of the light load; the full one's is 1")},
                        model_settings("model.")}),
            .files = {"savings.csv", "medians.csv", "coverage.csv"},
            .run = run_accuracy};
}

} // namespace app
