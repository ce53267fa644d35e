#include "apps/experiments/paper/tables.hpp"

#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

void write_database_table(const PaperRun& run, const std::filesystem::path& folder) {
    Csv table("id,H,gamma,phase_column,chromosomes,amplitude_after_rescaling");
    for (std::size_t i = 0; i < run.database.size(); ++i) {
        const auto& series = run.database[i].genome.series.front();
        table.row(i, series.H, series.gamma, i % static_cast<std::size_t>(run.layout.phase_columns) + 1,
                  series.chromosomes.size(), series.A * run.database[i].genome.scale);
    }
    rough::write_atomically(folder / "genomes.csv", table.text());
}

void write_target_tables(const TargetRun& target, const std::filesystem::path& folder) {
    Csv scores("id,similarity,similarity_low,similarity_high");
    for (std::size_t i = 0; i < target.database.size(); ++i)
        scores.row(i, target.database[i].all, target.database[i].low, target.database[i].high);
    rough::write_atomically(folder / "scores.csv", scores.text());

    Csv stages("variant,path,id,parent1,parent2,similarity");
    Csv curves(
        "variant,displacement_mm,pressure_MPa,contact_fraction,tangent_stiffness_MPa_per_mm,kkt_residual");
    for (const VariantRun& variant : target.variants) {
        for (const StageRecord& stage : variant.stages)
            for (const Candidate& one : stage.candidates) {
                const auto parent = [&](std::size_t i) {
                    return i < one.parents.size() ? std::to_string(one.parents[i]) : std::string();
                };
                stages.row(variant.name, stage.path, one.id, parent(0), parent(1), one.similarity);
            }
        const rough::Response& response = variant.answer.response;
        for (rough::Index j = 0; j < response.steps(); ++j)
            curves.row(variant.name, response.displacement[j], response.pressure[j],
                       response.contact_fraction[j], response.tangent_stiffness[j], response.kkt_residual[j]);
    }
    rough::write_atomically(folder / "stages.csv", stages.text());
    rough::write_atomically(folder / "curves.csv", curves.text());

    if (target.thresholds.empty())
        return;
    Csv thresholds("p_bar_MPa,variant,U1,U2,at_least_used,children,share_above,best_child,similarity");
    for (const ThresholdRow& row : target.thresholds)
        thresholds.row(row.p_bar, row.variant, row.u1, row.u2, row.at_least_used, row.children,
                       row.share_above, row.best_child, row.similarity);
    rough::write_atomically(folder / "thresholds.csv", thresholds.text());
}

} // namespace

void write_paper(const PaperRun& run, const std::filesystem::path& folder) {
    for (const TargetRun& target : run.targets) {
        const auto place = &target == &run.targets.front() ? folder : subfolder(folder, "heldout");
        write_target_tables(target, place);
        nlohmann::json result = result_json(
            {run.origin, run.searched, {run.searched}, run.max_pressure, target.target, target.variants});
        result["threshold_MPa"] = target.p_bar;
        write_json(place / "result.json", result);
    }
    write_database_table(run, folder);
}

} // namespace app
