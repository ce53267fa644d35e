#include "apps/experiments/accuracy/experiment.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

using nlohmann::json;

std::string savings_csv(const AccuracyRun& run) {
    Csv table("surface,kernel,load,sample,accuracy,seconds,resolved_seconds,estimated_error,true_error,nodes,"
              "resolved_nodes,dropped_chromosomes");
    for (const SavingRow& row : run.savings)
        table.row(row.surface, row.kernel, row.load, row.sample, row.accuracy, row.seconds,
                  row.resolved_seconds, row.estimated_error, row.true_error, row.nodes, row.resolved_nodes,
                  row.dropped);
    return table.text();
}

std::string searches_csv(const AccuracyRun& run) {
    Csv table("target,question,nodes,seconds,screened_seconds,genomes,given_up,same_survivors");
    for (const SearchRow& row : run.searches)
        table.row(row.target, row.question, row.nodes, row.seconds, row.screened_seconds, row.genomes,
                  row.given_up, row.same);
    return table.text();
}

std::string budget_csv(const AccuracyRun& run) {
    Csv table("kind,source,size");
    for (const BudgetRow& row : run.budget)
        table.row(row.kind, row.source, row.size);
    return table.text();
}

json result_json(const AccuracyRun& run) {
    json result = head_json(run.setup.model, {run.version, run.command, run.seed, run.threads});
    result["seconds"] = run.seconds;
    result["savings"] = json::array();
    for (const SavingRow& row : run.savings)
        result["savings"].push_back({{"surface", row.surface},
                                     {"kernel", row.kernel},
                                     {"load", row.load},
                                     {"sample", row.sample},
                                     {"accuracy", row.accuracy},
                                     {"seconds", row.seconds},
                                     {"resolved_seconds", row.resolved_seconds},
                                     {"estimated_error", row.estimated_error},
                                     {"true_error", row.true_error},
                                     {"nodes", row.nodes},
                                     {"resolved_nodes", row.resolved_nodes},
                                     {"dropped_chromosomes", row.dropped}});
    result["searches"] = json::array();
    for (const SearchRow& row : run.searches)
        result["searches"].push_back({{"target", row.target},
                                      {"question", row.question},
                                      {"nodes", row.nodes},
                                      {"seconds", row.seconds},
                                      {"screened_seconds", row.screened_seconds},
                                      {"genomes", row.genomes},
                                      {"given_up", row.given_up},
                                      {"same_survivors", row.same}});
    result["error_budget"] = json::array();
    for (const BudgetRow& row : run.budget)
        result["error_budget"].push_back({{"kind", row.kind}, {"source", row.source}, {"size", row.size}});
    if (!run.design.name.empty()) {
        const rough::Goal& goal = run.setup.goals.front();
        result["max_pressure_MPa"] = *run.setup.max_pressure;
        result["target"] = target_json({goal.name, goal.x, goal.y});
        result["variants"][run.design.name] = variant_json(run.design, loaded_models(run.setup));
    }
    return result;
}

} // namespace

void write_accuracy_study(const AccuracyRun& run, const std::filesystem::path& folder) {
    write_json(folder / "result.json", result_json(run));
    rough::write_atomically(folder / "savings.csv", savings_csv(run));
    rough::write_atomically(folder / "searches.csv", searches_csv(run));
    rough::write_atomically(folder / "budget.csv", budget_csv(run));
}

} // namespace app
