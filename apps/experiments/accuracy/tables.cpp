#include "apps/experiments/accuracy/run.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/text/atomic_file.hpp"

#include <map>
#include <tuple>

namespace app {

namespace {

Csv savings_table(const AccuracyRun& run) {
    Csv table("surface,kernel,load,sample,accuracy,seconds,resolved_seconds,estimated_error,true_error,nodes,"
              "resolved_nodes,dropped_chromosomes");
    for (const SavingRow& row : run.savings)
        table.row(row.surface, row.kernel, row.load, row.sample, row.accuracy, row.seconds,
                  row.resolved_seconds, row.estimated_error, row.true_error, row.nodes, row.resolved_nodes,
                  row.dropped);
    return table;
}

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

/// Whether the errors are what they are promised to be, for each accuracy.
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

Csv budget_table(const AccuracyRun& run) {
    Csv table("kind,source,size");
    for (const rough::ErrorSource& row : run.budget)
        table.row(row.kind, row.source, row.size);
    return table;
}

} // namespace

void write_accuracy_study(const AccuracyRun& run, const std::filesystem::path& folder) {
    const rough::DesignSetup& setup = run.setup;
    Record record{run.origin,         setup.model,           loaded_models(setup),
                  setup.max_pressure, setup.targets.front(), {}};
    if (!run.design.name.empty())
        record.variants.push_back(run.design);
    nlohmann::json result = result_json(record);
    result["seconds"] = run.seconds;
    const auto write = [&](const std::string& key, const std::string& file, const Csv& table) {
        result[key] = table.rows();
        rough::write_atomically(folder / file, table.text());
    };
    write("savings", "savings.csv", savings_table(run));
    rough::write_atomically(folder / "medians.csv", medians_table(run).text());
    rough::write_atomically(folder / "coverage.csv", coverage_table(run).text());
    write("error_budget", "budget.csv", budget_table(run));
    write_json(folder / "result.json", result);
}

} // namespace app
