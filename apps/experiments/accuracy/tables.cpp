#include "apps/experiments/accuracy/run.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/text/atomic_file.hpp"

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
    write("error_budget", "budget.csv", budget_table(run));
    write_json(folder / "result.json", result);
}

} // namespace app
