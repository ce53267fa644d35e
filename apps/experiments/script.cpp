#include "apps/experiments/paper/paper.hpp"
#include "apps/external/process.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/targets.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/base/held_folder.hpp"

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <sys/wait.h>

/// Experiments that are Python scripts: experiments/KIND.py, built into the program.
namespace app {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Where Python looks for modules: a folder, then the absolute folders of PYTHONPATH. An empty or a relative
/// one there would be found from the current folder, whose files nobody asked to run.
std::string module_path(const std::filesystem::path& folder) {
    std::string path = folder.string();
    const char* const before = std::getenv("PYTHONPATH");
    std::istringstream folders(before ? before : "");
    for (std::string one; std::getline(folders, one, ':');)
        if (one.starts_with('/'))
            path += ":" + one;
    return path;
}

/// Runs an experiment's script with the settings as JSON. The script writes result.json and tables.
Findings findings_of_script(const Settings& settings, const Conditions& conditions) {
    const std::string& kind = conditions.origin.kind;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    nlohmann::json given{
        {"folder", std::filesystem::absolute(ga::held_path(conditions.folder / "")).string()},
        {"program", program.string()},
        {"seed", conditions.origin.seed},
        {"threads", conditions.origin.threads},
        {"resume", conditions.resume},
        {"origin", origin_json(conditions.origin)}};
    for (const Claim& claim : paper_claims())
        if (claim.rule() != "cannot be decided")
            given["claims"].push_back({{"id", claim.id}, {"place", claim.place}, {"says", claim.sentence}});
    for (const Setting& one : experiment_named(kind).settings)
        given["settings"][one.name] = settings.text(one.name);
    if (settings.knows("targets.files"))
        for (const auto& file : target_files(settings, "targets.files"))
            given["targets"].push_back(std::filesystem::absolute(file).string());
    setenv("PYTHONPATH", module_path(program.parent_path() / "python").c_str(), 1);
    const File nothing(std::fopen("/dev/null", "r+"), std::fclose), errors(std::tmpfile(), std::fclose);
    pid_t child = 0;
    if (!nothing || !errors ||
        start_process(
            child, {"python3", "-P", "-c", builtin_files().at(kind + ".py"), rough::json_text(given, true)},
            fileno(nothing.get()), fileno(nothing.get()), fileno(errors.get())) != 0)
        rough::refuse(kind, ": python3 was not found; install the Debian package python3");
    conditions.progress.show(kind + ".py");
    int status = 0;
    while (!process_ended_within(0.2, child, status))
        if (conditions.stop)
            end_group(child, SIGTERM);
    if (!conditions.stop && (!WIFEXITED(status) || WEXITSTATUS(status) != 0)) {
        const std::string problem =
            last_line(rough::read_whole("/proc/self/fd/" + std::to_string(fileno(errors.get()))));
        rough::refuse(kind, ": ", problem,
                      problem.find("No module") == std::string::npos
                          ? ""
                          : "; install python3, numpy and the Python module rugosa");
    }
    const std::filesystem::path result = conditions.folder / "result.json";
    if (!std::filesystem::exists(result))
        return {};
    nlohmann::json found = rough::parsed_json(rough::read_whole(result), result.string());
    return {.result = found, .summary = found.value("summary", "")};
}

} // namespace

Experiment features_experiment() {
    return {.kind = "features",
            .settings = joined(
                {{{"features.answers", "200", "different answers for each target, and as many that miss"},
                  {"features.similarity", "0.99", "lowest similarity of an answer"},
                  {"features.difference", "0.001",
                   "minimum difference of two answers: 1 less the correlation of their heights"},
                  {"features.starts", "6000", "maximum number of starts"},
                  {"features.held-out", "128", "starts of the held-out check"},
                  {"targets.files", "", "target curves (CSV), separated by commas"},
                  max_pressure_setting("targets.", "1.6e-4")},
                 model_settings("model.")}),
            .files = {"features.csv", "waves.csv", "heldout.csv", "best"},
            .run = findings_of_script};
}

Experiment metainterfaces_experiment() {
    std::vector<Setting> caps = cap_settings("caps.");
    for (Setting& setting : caps)
        setting.fallback = setting.name == "caps.asperities" ? "8x8" : "";
    return {
        .kind = "metainterfaces",
        .settings = joined(
            {{{"targets.files", "", "laws of area against load (CSV), separated by commas"},
              positive("caps.modulus", "1.36", "effective modulus E*, MPa"),
              ga::number("caps.similarity", "0.98", -1, 1, "required similarity"),
              ga::whole("caps.nodes", "", 32, "nodes along each side of the verification [1024]").up_to(4096),
              {"caps.accuracy", "", "relative error allowed for the model of the search"},
              {"caps.large-laws", "", "names of the laws of the larger array"},
              {"caps.large-asperities", "40x25", "caps of the larger array, NXxNY"},
              {"caps.large-pipeline", "default", "pipeline for the larger array"}},
             caps}),
        .files = {"laws.csv", "curves.csv"},
        .run = findings_of_script};
}

Experiment readings_experiment() {
    return {
        .kind = "readings",
        .settings = joined(
            {{Setting("readings.quick", "off",
                      "on tries one choice at a time and two databases: 3 minutes of processor time")
                  .of({"off", "on"}),
              ga::whole("readings.databases", "20", 0, "databases with other phases, tried under our reading")
                  .up_to(1000),
              max_pressure_setting("readings.", "1.6e-4")},
             model_settings("model.")}),
        .files = {"cells.csv", "claims.csv", "shares.csv", "readings.json", "targets"},
        .run =
            [](const Settings& settings, const Conditions& conditions) {
                expect_none(settings, {"model.kernel", "model.datum", "model.reach"},
                            "cannot be set, because the readings try several values; omit it");
                model_from(settings, "model.");
                return findings_of_script(settings, conditions);
            },
        .resumes = true};
}

} // namespace app
