#include "apps/experiments/paper/paper.hpp"
#include "apps/prompt/model_settings.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <numbers>

namespace app {

namespace {

/// Throws rough::InputError if the two keys that end in from and to are in the wrong order.
void expect_order(const Settings& settings, const std::string& name) {
    if (settings.number(name + "from") > settings.number(name + "to"))
        settings.refuse(name + "to", settings.text(name + "to"),
                        " is below the start of the range; give at least ", settings.text(name + "from"));
}

/// The keys whose values a run keeps as they are.
Fields fields_of(PaperRun& run) {
    rough::DatabaseLayout& layout = run.layout;
    return {
        {pressure("paper.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"), run.max_pressure},
        {Setting(
             "paper.dominance", "pressure",
             "Algorithm 1 compares K at the same pressure, K at the same load step, or raw tangents by step")
             .of({"pressure", "step", "raw"}),
         run.dominance},
        {ga::number("paper.dominant-above", "0.95", 0, 1,
                    "correlation above which it finds a chromosome dominant"),
         run.dominant_above},
        {Setting("paper.cco-reduces", "parents", "genomes to which CCO applies it")
             .of({"parents", "children"}),
         run.reduces_children},
        {ga::whole("database.pairs", "20", 1, "Sobol pairs (H, gamma)").up_to(100000), layout.pairs},
        {ga::whole("database.phase-columns", "5", 1, "Sobol phase columns").up_to(1000),
         layout.phase_columns},
        {ga::number("database.hurst-from", "0.5", ga::above_zero, 10, "lowest H"), layout.H_from},
        {ga::number("database.hurst-to", "1.5", ga::above_zero, 10, "highest H"), layout.H_to},
        {ga::number("database.gamma-from", "1.4", 1.01, 100, "lowest gamma"), layout.gamma_from},
        {ga::number("database.gamma-to", "2", 1.01, 100, "highest gamma"), layout.gamma_to},
        {positive("database.A", "1", "amplitude A"), layout.A},
        {positive("database.lambda", "", "longest wave, mm [L]"), layout.lambda},
        {positive("database.shortest-wave", "", "shortest wave, mm [the grid's spacing]"), layout.shortest},
        {Setting("database.first-point", "skipped", "the first point of Sobol's sequences")
             .of({"skipped", "kept"}),
         layout.with_first},
        {ga::whole("database.phases", "0", 0,
                   "0: Sobol's phases; 1, 2, ...: this set of phases drawn from the seed")
             .up_to(1000000),
         run.phases},
    };
}

/// A measured profile's response as a target: K at 20 even pressures up to its last one.
rough::Target target_of(const rough::Source& scan, const rough::Model& model, const std::string& name) {
    const rough::Response response = respond(scan.measured, model);
    const rough::Curve curve = secant_stiffness(response);
    rough::Target target;
    target.name = name;
    target.x.resize(20);
    for (rough::Index k = 0; k < 20; ++k)
        target.x[k] = curve.to * static_cast<double>(k + 1) / 20;
    target.y = target.x.unaryExpr([&](double p) { return curve.at(p); });
    return target;
}

/// The paper's targets contain only K. A recorded model would be ignored, so it is refused.
rough::Target stiffness_from(const std::string& file) {
    rough::Target target = rough::read_target(file);
    if (target.quantity != rough::Quantity::stiffness || target.has_band() || !target.recorded.empty())
        rough::refuse(file, ": has another quantity, a band or a recorded model; give only "
                            "pressure_MPa,stiffness_MPa_per_mm");
    return target;
}

/// The model and the targets.
void take_targets(const Settings& settings, PaperRun& run) {
    if (settings.has("target.profile")) {
        const rough::Source scan = scan_from(settings.path("target.profile"), settings, 0, "target.");
        run.searched = model_from(settings, scan, "model.");
        if (!settings.has("model.nodes"))
            run.searched.grid.nodes = 512;
        run.targets = {{"measured", target_of(scan, run.searched, settings.text("target.profile"))}};
        return;
    }
    if (!settings.has("target.file"))
        settings.refuse("target.file",
                        "missing; name a target (CSV), or a measured profile as target.profile");
    run.searched = model_from(settings, "model.");
    run.targets = {{"drawn", stiffness_from(settings.path("target.file"))}};
    if (settings.has("heldout.file"))
        run.targets.push_back({"held-out", stiffness_from(settings.path("heldout.file"))});
}

/// The sentence on each claim from an experiment of kind readings.
std::map<std::string, std::string> readings_from(const std::filesystem::path& file) {
    try {
        return rough::parsed_json(rough::read_whole(file), file.string()).at("claims");
    } catch (const nlohmann::json::exception&) {
        rough::refuse(file.string(), ": has no sentence on each claim; give readings.json of an "
                                     "experiment of kind readings");
    }
}

} // namespace

std::vector<Setting> paper_settings() {
    const std::vector<Setting> settings{
        {"target.file", "", "target curve (CSV)"},
        {"target.profile", "", "measured profile whose response is the target, instead of target.file"},
        {"heldout.file", "", "second target curve (CSV)"},
        {"variants.*", "", "NAME = pipeline: further variants, as text (rugosa operators)"},
        ga::number("paper.threshold", "0.5", 0, 1, "p_bar over p_max"),
        ga::number("paper.sweep-from", "0.31", 0.01, 1, "first p_bar over p_max of the threshold sweep"),
        ga::number("paper.sweep-to", "0.69", 0.01, 1, "last p_bar over p_max of the sweep"),
        ga::whole("paper.sweep-points", "20", 0, "number of thresholds; 0: no sweep").up_to(1000),
        {"paper.readings", "",
         "readings.json of an experiment of kind readings: claims under other readings"},
        ga::number("paper.phase-relative", "0.1", 0, 10,
                   "maximum change of a phase by refinement, over paper.phase-of"),
        Setting("paper.phase-of", "value", "value: the phase itself; turn: 2 pi").of({"value", "turn"}),
    };
    PaperRun run;
    return joined({settings,
                   settings_of(fields_of(run)),
                   scan_settings("target."),
                   model_settings("model."),
                   {accuracy_setting("model.")}});
}

PaperRun paper_from(const Settings& settings, const Origin& origin) {
    PaperRun run;
    run.origin = origin;
    take_targets(settings, run);
    run.searched.accuracy = accuracy_from(settings, "model.");
    run.model = exactly(run.searched);
    run.layout.lambda = run.model.grid.length;
    run.layout.shortest = run.model.grid.spacing();
    take(settings, fields_of(run));
    for (const char* range : {"database.hurst-", "database.gamma-", "paper.sweep-"})
        expect_order(settings, range);
    if (settings.has("target.profile"))
        run.max_pressure = run.targets[0].target.last();
    run.p_bar = settings.number("paper.threshold") * run.max_pressure;
    if (settings.has("paper.readings"))
        run.other_readings = readings_from(settings.path("paper.readings"));
    const double share = settings.number("paper.phase-relative");
    if (settings.choice("paper.phase-of") == 1)
        run.reach = {0, share * 2 * std::numbers::pi};
    else
        run.reach = {share, 0};
    return run;
}

} // namespace app
