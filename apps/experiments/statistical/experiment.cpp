#include "apps/experiments/experiment.hpp"

#include "apps/prompt/units.hpp"
#include "domain/design/statistical.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/scan/map.hpp"

namespace app {

namespace {

const char* const usual_pipeline =
    "sample 40 | score | until evaluations 2000 { l-shade evaluations=2000 | score | duel } | best 1";

rough::StatisticalTask task_of(const Settings& settings) {
    if (!settings.has("target.file"))
        settings.refuse("target.file", "missing; name a target's file (CSV)");
    rough::StatisticalTask task;
    task.target = rough::read_target(settings.path("target.file"));
    settings.take("statistical.theory", task.theory);
    settings.take("statistical.surface", task.is_area);
    task.nodes = settings.whole("statistical.nodes");
    if (task.is_area && task.nodes > 2048)
        settings.refuse("statistical.nodes", settings.text("statistical.nodes"),
                        " is out of range for a map (40 to 2048 along each side)");
    task.length = settings.number("statistical.length");
    task.effective_modulus = settings.number("statistical.modulus");
    return task;
}

Findings run_statistical(const Settings& settings, const Conditions& conditions) {
    const rough::StatisticalTask task = task_of(settings);
    conditions.progress.show("parameters");
    const rough::StatisticalAnswer answer = read_at(settings, "statistical.pipeline", [&] {
        return statistical_design(task, settings.text("statistical.pipeline"), conditions.origin.seed,
                                  conditions.origin.threads, &conditions.stop);
    });
    const std::string theory = name_of(task.theory);
    const rough::Target& target = task.target;
    Findings found;
    Csv& curves =
        found.table("curves.csv", "curve,pressure_MPa," + std::string(columns_of(target.quantity).y));
    curves.points(target.x, target.y, "target");
    curves.points(target.x, answer.predicted, theory);
    const rough::SelfAffine& of = answer.parameters;
    found.result = {
        {"theory", theory},
        {"quantity", is_contact_fraction(target.quantity) ? "Contact fraction A" : "Stiffness K (MPa/mm)"},
        {"parameters",
         {{"H", of.hurst},
          {"longest_mm", of.longest},
          {"shortest_mm", of.shortest},
          {"rms_slope", of.rms_slope}}},
        {"similarity", answer.similarity},
        {"evaluations", answer.evaluations},
        {"similarity_realised", nlohmann::json::array()},
        {"surfaces", nlohmann::json::array()}};
    const long count = settings.whole("statistical.realisations");
    for (long k = 1; k <= count && !conditions.stop; ++k) {
        const std::string name = "surface-" + std::to_string(k);
        conditions.progress.show(name + " of " + std::to_string(count));
        const rough::RealisedAnswer drawn =
            realised_answer(task, answer.parameters, conditions.origin.seed + static_cast<std::uint64_t>(k));
        curves.points(target.x, drawn.exact, name);
        found.result["similarity_realised"].push_back(drawn.similarity);
        found.result["surfaces"].push_back({{"similarity", drawn.similarity}});
        found.files[name + ".x3p"] = x3p(drawn.surface);
    }
    found.result["curves"] = curves.rows();
    found.summary = "similarity " + readable(answer.similarity, 4) + " by " + theory + "'s theory";
    return found;
}

} // namespace

Experiment statistical_experiment() {
    return {
        .kind = "statistical",
        .summary =
            "Finds the statistical parameters of a surface (H, two cut-offs, rms slope) whose curve, by a "
            "theory, is the target's, and solves surfaces with these parameters. Writes curves.csv, the "
            "surfaces (X3P) and a page.",
        .settings =
            {{"target.file", "", "stiffness or contact fraction against pressure, CSV"},
             Setting("statistical.theory", "persson", "theory of contact").of(rough::theory_names()),
             Setting("statistical.surface", "area", "area, or profile (only with persson)")
                 .of({"profile", "area"}),
             ga::whole("statistical.nodes", "128", 40, "nodes along each side; waves have at least 8 nodes")
                 .up_to(1000000),
             positive("statistical.length", "1", "length of each side, mm"),
             positive("statistical.modulus", "1", "effective modulus E*, MPa"),
             ga::whole("statistical.realisations", "3", 0, "number of surfaces to draw and solve").up_to(100),
             {"statistical.pipeline", usual_pipeline, "search for the parameters"}},
        .files = {"curves.csv", "*.x3p"},
        .run = run_statistical};
}

} // namespace app
