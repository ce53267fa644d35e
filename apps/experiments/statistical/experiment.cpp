#include "apps/experiments/experiment.hpp"

#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/page.hpp"
#include "apps/report/result.hpp"
#include "apps/report/units.hpp"
#include "domain/design/statistical.hpp"
#include "domain/scan/x3p.hpp"
#include "domain/target/names.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

const char* const usual_pipeline =
    "sample 40 | score | until evaluations 2000 { l-shade evaluations=2000 | score | duel } | best 1";

/// What a run was asked for and found.
struct StatisticalRun {
    rough::StatisticalTask task;
    rough::StatisticalAnswer answer;
    std::vector<rough::RealisedAnswer> surfaces;
};

std::string surface_file(std::size_t k) { return "surface-" + std::to_string(k + 1) + ".x3p"; }

rough::StatisticalTask task_of(const Settings& settings) {
    if (!settings.has("target.file"))
        throw rough::InputError(settings.place("target.file") + ": missing, expected a target's file");
    rough::StatisticalTask task;
    task.target = rough::read_target(settings.path("target.file"));
    task.theory = static_cast<rough::Theory>(settings.one_of("statistical.theory", rough::theory_names()));
    task.is_area = settings.one_of("statistical.surface", {"profile", "area"}) == 1;
    task.nodes = settings.whole("statistical.nodes", 40, task.is_area ? 2048 : 1'000'000);
    task.length = settings.positive("statistical.length");
    task.effective_modulus = settings.positive("statistical.modulus");
    return task;
}

Csv curves_table(const StatisticalRun& run) {
    Csv table("curve,pressure_MPa," + std::string(columns_of(run.task.target.quantity).y));
    const auto add = [&](const std::string& name, const Eigen::VectorXd& y) {
        for (Eigen::Index k = 0; k < y.size(); ++k)
            table.row(name, run.task.target.x[k], y[k]);
    };
    add("target", run.task.target.y);
    add(name_of(run.task.theory), run.answer.foretold);
    for (std::size_t k = 0; k < run.surfaces.size(); ++k)
        add("surface-" + std::to_string(k + 1), run.surfaces[k].exact);
    return table;
}

void write_run(const StatisticalRun& run, const Origin& origin, const std::filesystem::path& folder) {
    const Csv table = curves_table(run);
    rough::write_atomically(folder / "curves.csv", table.text());
    for (std::size_t k = 0; k < run.surfaces.size(); ++k)
        rough::write_atomically(folder / surface_file(k), x3p(run.surfaces[k].surface));
    const rough::SelfAffine& of = run.answer.parameters;
    nlohmann::json result = origin_json(origin);
    result["theory"] = name_of(run.task.theory);
    result["parameters"] = {{"H", of.hurst},
                            {"longest_mm", of.longest},
                            {"shortest_mm", of.shortest},
                            {"rms_slope", of.rms_slope}};
    result["similarity"] = run.answer.similarity;
    result["evaluations"] = run.answer.evaluations;
    result["similarity_realised"] = nlohmann::json::array();
    for (const rough::RealisedAnswer& surface : run.surfaces)
        result["similarity_realised"].push_back(surface.similarity);
    result["curves"] = table.rows();
    write_json(folder / "result.json", result);
}

std::string page_of(const StatisticalRun& run) {
    const rough::SelfAffine& of = run.answer.parameters;
    const std::string theory = name_of(run.task.theory);
    Page page("A design without heights", "Statistical parameters for a target by " + theory +
                                              "'s theory, and the exact curves of surfaces that have them.");
    page.tiles({{"Hurst exponent H", readable(of.hurst)},
                {"Long cut-off, mm", readable(of.longest)},
                {"Short cut-off, mm", readable(of.shortest)},
                {"Root mean square slope", readable(of.rms_slope)},
                {"Similarity by the theory", readable(run.answer.similarity, 4)}});
    Plot plot;
    plot.alt = "The target, the theory's curve and the exact curves of realised surfaces against pressure";
    plot.x = {"Mean pressure p (MPa)", true};
    plot.y = {is_area(run.task.target.quantity) ? "Contact fraction A" : "Stiffness K (MPa/mm)", true};
    const Eigen::VectorXd& x = run.task.target.x;
    plot.series.push_back({"target", x, run.task.target.y, Colour::text, Style::points, 3});
    plot.series.push_back({theory, x, run.answer.foretold, Colour::orange, Style::line, 2});
    Table table{"Similarity (Eq. 12) to the target", {"Curve", "Similarity"}, {}, {false, true}};
    table.rows.push_back({theory, readable(run.answer.similarity, 4)});
    std::vector<std::string> files{"result.json", "curves.csv"};
    for (std::size_t k = 0; k < run.surfaces.size(); ++k) {
        const std::string name = "surface " + std::to_string(k + 1) + ", exact";
        plot.series.push_back({name, x, run.surfaces[k].exact, Colour::blue, Style::line, 1.2});
        table.rows.push_back({name, readable(run.surfaces[k].similarity, 4)});
        files.push_back(surface_file(k));
    }
    page.figure({"curves", "Foretold and exact.", "A surface is one draw of random phases.", {plot}});
    page.table(table);
    page.section("Files");
    page.links(files);
    return page.html();
}

Findings run_statistical(const Settings& settings, const Conditions& conditions) {
    const auto run = std::make_shared<StatisticalRun>();
    run->task = task_of(settings);
    conditions.progress.show("parameters");
    run->answer = read_at(settings, "statistical.pipeline", [&] {
        return statistical_design(run->task, settings.text("statistical.pipeline"), conditions.origin.seed,
                                  conditions.origin.threads, &conditions.stop);
    });
    const long count = settings.whole("statistical.realisations", 0, 100);
    for (long k = 1; k <= count && !conditions.stop; ++k) {
        conditions.progress.show("surface " + std::to_string(k) + " of " + std::to_string(count));
        run->surfaces.push_back(realised_answer(run->task, run->answer.parameters,
                                                conditions.origin.seed + static_cast<std::uint64_t>(k)));
    }
    return {
        [run, origin = conditions.origin, folder = conditions.folder] { write_run(*run, origin, folder); },
        [run] { return page_of(*run); },
        "similarity " + readable(run->answer.similarity, 4) + " by the theory" +
            (run->surfaces.empty()
                 ? ""
                 : ", " + readable(run->surfaces.front().similarity, 4) + " of the first surface, exact")};
}

} // namespace

Experiment statistical_experiment() {
    return {
        .kind = "statistical",
        .summary =
            "Finds the statistical parameters of a surface (H, two cut-offs, rms slope) whose curve, as "
            "a theory foretells it, is the target's, and solves surfaces that have them. Writes "
            "curves.csv, the surfaces (X3P) and a page.",
        .settings = {{"target.file", "", "stiffness or contact fraction against pressure, CSV"},
                     {"statistical.theory", "persson", "greenwood-williamson, bush-gibson-thomas or persson"},
                     {"statistical.surface", "area", "area, or profile (persson alone)"},
                     {"statistical.nodes", "128", "of the surfaces, a side; no wave is under 8 nodes"},
                     {"statistical.length", "1", "of the surfaces, mm"},
                     {"statistical.modulus", "1", "effective modulus E*, MPa"},
                     {"statistical.realisations", "3", "surfaces that are drawn and solved"},
                     {"statistical.pipeline", usual_pipeline, "how the parameters are searched for"}},
        .files = {"curves.csv", "*.x3p"},
        .run = run_statistical};
}

} // namespace app
