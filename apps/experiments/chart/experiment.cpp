#include "apps/experiments/experiment.hpp"

#include "apps/experiments/chart/course.hpp"
#include "apps/experiments/chart/tables.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/base/stopwatch.hpp"

namespace app {

namespace {

/// chart.csv as it grows, every few seconds.
class GrowingTable {
  public:
    explicit GrowingTable(std::filesystem::path file) : file_(std::move(file)) {}
    void grow(const ChartData& data) {
        if (data.runs.empty() || written_.seconds() < 3)
            return;
        rough::write_atomically(file_, chart_table(data).text());
        written_ = ga::Stopwatch();
    }

  private:
    std::filesystem::path file_;
    ga::Stopwatch written_;
};

void write_chart(const ChartData& data, const Origin& origin, const std::filesystem::path& folder) {
    const Csv table = chart_table(data);
    rough::write_atomically(folder / "chart.csv", table.text());
    rough::write_atomically(folder / "models.csv", models_table(data.models).text());
    nlohmann::json result = origin_json(origin);
    rough::write_atomically(folder / "points.csv", points_table(data).text());
    rough::write_atomically(folder / "model_errors.csv", model_errors_table(data.models).text());
    result.update(chart_facts(data));
    result["runs"] = table.rows();
    write_json(folder / "result.json", result);
}

Findings run_chart_experiment(const Settings& settings, const Conditions& conditions) {
    const std::filesystem::path folder = conditions.folder;
    GrowingTable table(folder / "chart.csv");
    const bool quick = settings.is_on("chart.quick");
    const auto data = std::make_shared<const ChartData>(charted(
        chart_scenes(), quick ? quick_extent() : whole_extent(),
        {60 * settings.positive("chart.minutes"), quick ? 128 : 256, [&] { return conditions.stop.load(); },
         [&](const ChartData& so_far, const std::string& where) {
             conditions.progress.show(where);
             table.grow(so_far);
         }}));
    if (data->runs.empty())
        return {};
    const std::string left_out = left_out_in_a_line(*data);
    return {.write = [=, origin = conditions.origin] { write_chart(*data, origin, folder); },
            .summary = std::to_string(data->runs.size()) + " settings charted" +
                       (left_out.empty() ? "" : "; " + left_out)};
}

} // namespace

Experiment chart_experiment() {
    return {
        .kind = "chart",
        .summary =
            "Charts the time of a pressure curve against its error for theories, profiles and maps, and for "
            "every contact solver, grid, "
            "number of load steps and tolerance, on scenes with a known or a refined solution: from "
            "coarse grids to fine, so that a chart that ends early has the same of every scene. Writes "
            "chart.csv (as it goes), models.csv and a page that says which model and method "
            "to "
            "take when, and "
            "what was left out and why. Ctrl-C ends it; what was measured is kept.",
        .settings = {{"chart.minutes", "10",
                      "begin nothing that would not end within so many; the coarsest grid is always done"},
                     {"chart.quick", "", "fewer and smaller grids: under a minute", true}},
        .files = {"chart.csv", "points.csv", "models.csv", "model_errors.csv"},
        .run = run_chart_experiment,
        .examples = {"chart --quick --out out/chart", "chart --minutes 3 --out out/chart"}};
}

} // namespace app
