#include "apps/experiments/study.hpp"
#include "apps/report/units.hpp"
#include "domain/design/statistical.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/scan/map.hpp"
#include "domain/target/target.hpp"

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

nlohmann::json result_of(const StatisticalRun& run) {
    const rough::SelfAffine& of = run.answer.parameters;
    return {{"theory", name_of(run.task.theory)},
            {"parameters",
             {{"H", of.hurst},
              {"longest_mm", of.longest},
              {"shortest_mm", of.shortest},
              {"rms_slope", of.rms_slope}}},
            {"similarity", run.answer.similarity},
            {"evaluations", run.answer.evaluations},
            {"similarity_realised", rough::column(run.surfaces, &rough::RealisedAnswer::similarity)}};
}

void fill_page(Page& page, const StatisticalRun& run) {
    const rough::SelfAffine& of = run.answer.parameters;
    const rough::Target& target = run.task.target;
    page.tiles({{"Hurst exponent H", readable(of.hurst)},
                {"Long cut-off, mm", readable(of.longest)},
                {"Short cut-off, mm", readable(of.shortest)},
                {"Root mean square slope", readable(of.rms_slope)},
                {"Similarity by the theory", readable(run.answer.similarity, 4)}});
    Plot plot;
    plot.alt = "The target, the theory's curve and the exact curves of realised surfaces against pressure";
    plot.x = {"Mean pressure p (MPa)", true};
    plot.y = {is_contact_fraction(target.quantity) ? "Contact fraction A" : "Stiffness K (MPa/mm)", true};
    plot.series = {{"target", target.x, target.y, Colour::text, Style::points, 3},
                   {name_of(run.task.theory), target.x, run.answer.foretold, Colour::orange, Style::line, 2}};
    nlohmann::json rows{{{"curve", name_of(run.task.theory)}, {"similarity", run.answer.similarity}}};
    for (std::size_t k = 0; k < run.surfaces.size(); ++k) {
        const std::string name = "surface " + std::to_string(k + 1) + ", exact";
        plot.series.push_back({name, target.x, run.surfaces[k].exact, Colour::blue, Style::line, 1.2});
        rows.push_back({{"curve", name}, {"similarity", run.surfaces[k].similarity}});
    }
    page.figure({"curves", "Foretold and exact.", "A surface is one draw of random phases.", {plot}});
    page.table(
        shown(rows, {{"curve", "Curve"}, {"similarity", "Similarity"}}, "Similarity (Eq. 12) to the target"));
    page.section("How");
}

Findings run_statistical(const Settings& settings, const Conditions& conditions) {
    StatisticalRun run;
    run.task = task_of(settings);
    conditions.progress.show("parameters");
    run.answer = read_at(settings, "statistical.pipeline", [&] {
        return statistical_design(run.task, settings.text("statistical.pipeline"), conditions.origin.seed,
                                  conditions.origin.threads, &conditions.stop);
    });
    const rough::Target& target = run.task.target;
    Csv curves("curve,pressure_MPa," + std::string(columns_of(target.quantity).y));
    const auto add = [&](const std::string& name, const Eigen::VectorXd& y) {
        for (Eigen::Index k = 0; k < y.size(); ++k)
            curves.row(name, target.x[k], y[k]);
    };
    add("target", target.y);
    add(name_of(run.task.theory), run.answer.foretold);
    Study study;
    const long count = settings.whole("statistical.realisations", 0, 100);
    for (long k = 1; k <= count && !conditions.stop; ++k) {
        const std::string name = "surface-" + std::to_string(k);
        conditions.progress.show(name + " of " + std::to_string(count));
        run.surfaces.push_back(realised_answer(run.task, run.answer.parameters,
                                               conditions.origin.seed + static_cast<std::uint64_t>(k)));
        add(name, run.surfaces.back().exact);
        study.files.emplace_back(name + ".x3p", x3p(run.surfaces.back().surface));
    }
    study.words = {
        "Similarity " + readable(run.answer.similarity, 4) + " by " + name_of(run.task.theory) + "'s theory" +
        (run.surfaces.empty()
             ? ""
             : ", " + readable(run.surfaces.front().similarity, 4) + " of the first surface, exact")};
    study.tables.emplace_back("curves.csv", "curves", curves);
    study.result = result_of(run);
    return findings_of(conditions, "A design without heights", std::move(study),
                       [run](Page& page) { fill_page(page, run); });
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
