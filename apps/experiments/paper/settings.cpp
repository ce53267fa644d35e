#include "apps/experiments/paper/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "domain/errors.hpp"
#include "domain/response/curve.hpp"
#include "domain/text/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <limits>
#include <numbers>

namespace app {

namespace {

rough::DatabaseLayout layout_from(const Settings& settings, const rough::Model& model) {
    rough::DatabaseLayout layout;
    layout.pairs = static_cast<int>(settings.whole("database.pairs", 1, 100000));
    layout.phase_columns = static_cast<int>(settings.whole("database.phase-columns", 1, 1000));
    layout.H_from = settings.number("database.hurst-from", std::numeric_limits<double>::min(), 10);
    layout.H_to = settings.number("database.hurst-to", layout.H_from, 10);
    layout.gamma_from = settings.number("database.gamma-from", 1.01, 100);
    layout.gamma_to = settings.number("database.gamma-to", layout.gamma_from, 100);
    layout.A = settings.positive("database.A");
    layout.with_first = settings.one_of("database.first-point", {"skipped", "kept"}) == 1;
    layout.lambda =
        settings.has("database.lambda") ? settings.positive("database.lambda") : model.grid.length;
    layout.shortest = settings.has("database.shortest-wave") ? settings.positive("database.shortest-wave")
                                                             : model.grid.spacing();
    return layout;
}

/// The target that a measured profile's own response is: K at 20 even pressures up to its last.
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

/// The paper's targets are of K alone; what a file records of its model is held against none here.
rough::Target stiffness_from(const std::string& file) {
    rough::Target target = rough::read_target(file);
    if (target.quantity != rough::Quantity::stiffness || target.has_band() || !target.recorded.empty())
        throw rough::InputError(file +
                                ": a target of another quantity, with a band or a recorded model given, "
                                "expected pressure_MPa,stiffness_MPa_per_mm alone");
    return target;
}

void take_measured_target(const Settings& settings, PaperRun& run) {
    const rough::Source scan = scan_from(settings.path("target.profile"), settings, 0, "target.");
    run.searched = model_from(settings, scan, "model.");
    if (!settings.has("model.nodes"))
        run.searched.grid.nodes = 512;
    run.targets.push_back(
        {"measured", target_of(scan, run.searched, settings.text("target.profile")), 0, {}, {}, {}});
    run.max_pressure = run.targets[0].target.last();
}

void take_target_files(const Settings& settings, PaperRun& run) {
    if (!settings.has("target.file"))
        throw rough::InputError(settings.place("target.file") +
                                ": missing, expected a target (CSV), or target.profile, a measured profile");
    run.searched = model_from(settings, "model.");
    run.max_pressure = settings.pressure("paper.max-pressure");
    run.targets.push_back({"drawn", stiffness_from(settings.path("target.file")), 0, {}, {}, {}});
    if (settings.has("heldout.file"))
        run.targets.push_back({"held-out", stiffness_from(settings.path("heldout.file")), 0, {}, {}, {}});
}

/// What an experiment of kind readings has found, claim by claim.
std::map<std::string, std::string> readings_from(const std::filesystem::path& file) {
    try {
        return nlohmann::json::parse(rough::read_whole(file)).at("claims");
    } catch (const nlohmann::json::exception& error) {
        throw rough::InputError(file.string() + ": " + error.what() +
                                ", expected readings.json of an experiment of kind readings");
    }
}

} // namespace

std::vector<Setting> paper_settings() {
    const std::vector<Setting> settings{
        {"target.file", "", "target curve (CSV)"},
        {"target.profile", "", "measured profile whose response is the target, in place of target.file"},
        {"heldout.file", "", "second target curve (CSV)"},
        {"variants.*", "", "NAME = pipeline: further variants, as text (rugosa operators)"},
        {"paper.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"},
        {"paper.threshold", "0.5", "p_bar over p_max"},
        {"paper.sweep-from", "0.31", "first p_bar over p_max of the threshold sweep"},
        {"paper.sweep-to", "0.69", "last one"},
        {"paper.sweep-points", "20", "how many; 0: no sweep"},
        {"paper.readings", "",
         "readings.json of an experiment of kind readings: what other readings make of each claim"},
        {"paper.dominance", "pressure",
         "Algorithm 1 compares K at the same pressure, K at the same load step, or raw tangents by step: "
         "pressure, step or raw"},
        {"paper.dominant-above", "0.95", "correlation above which it finds a chromosome dominant"},
        {"paper.cco-reduces", "parents", "CCO applies it to the parents, or to the children"},
        {"paper.phase-relative", "0.1", "how far refinement moves a phase, over paper.phase-of"},
        {"paper.phase-of", "value", "value: the phase's own value; turn: 2 pi"},
        {"database.pairs", "20", "Sobol pairs (H, gamma)"},
        {"database.phase-columns", "5", "Sobol phase columns"},
        {"database.hurst-from", "0.5", "lowest H"},
        {"database.hurst-to", "1.5", "highest H"},
        {"database.gamma-from", "1.4", "lowest gamma"},
        {"database.gamma-to", "2", "highest gamma"},
        {"database.A", "1", "amplitude A"},
        {"database.lambda", "", "longest wave, mm [L]"},
        {"database.shortest-wave", "", "shortest wave, mm [the grid's spacing]"},
        {"database.first-point", "skipped", "the first point of Sobol's sequences: skipped or kept"},
        {"database.phases", "0", "0: Sobol's phases; 1, 2, ...: this set of phases drawn from the seed"},
    };
    return joined(
        {settings, scan_settings("target."), model_settings("model."), {accuracy_setting("model.")}});
}

PaperRun paper_from(const Settings& settings, const Origin& origin) {
    PaperRun run;
    run.origin = origin;
    if (settings.has("target.profile"))
        take_measured_target(settings, run);
    else
        take_target_files(settings, run);
    run.searched.accuracy = accuracy_from(settings, "model.");
    run.model = exactly(run.searched);
    for (TargetRun& target : run.targets)
        target.p_bar = settings.number("paper.threshold", 0, 1) * run.max_pressure;
    run.layout = layout_from(settings, run.model);
    if (settings.has("paper.readings"))
        run.other_readings = readings_from(settings.path("paper.readings"));
    run.phases = static_cast<std::uint64_t>(settings.whole("database.phases", 0, 1000000));
    run.dominance =
        static_cast<rough::DominanceReading>(settings.one_of("paper.dominance", {"pressure", "step", "raw"}));
    run.dominant_above = settings.number("paper.dominant-above", 0, 1);
    run.reduces_children = settings.one_of("paper.cco-reduces", {"parents", "children"}) == 1;
    const double share = settings.number("paper.phase-relative", 0, 10);
    if (settings.one_of("paper.phase-of", {"value", "turn"}) == 1)
        run.reach = {0, share * 2 * std::numbers::pi};
    else
        run.reach = {share, 0};
    return run;
}

} // namespace app
