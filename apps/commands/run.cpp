#include "apps/commands/commands.hpp"
#include "apps/experiments/experiment.hpp"
#include "apps/prompt/model_settings.hpp"

namespace app {
namespace {

Setting set_setting() {
    return Setting("set", "", "change a key of the experiment, section.key=value; may be repeated").several('\n');
}

std::vector<Setting> run_settings() {
    std::vector<Setting> settings{
        {"experiment", "", "the experiment's .ini file (may be given without the flag)"},
        {"out", "", "folder for the results [out/NAME, or out/NAME-2 and on]"},
        force_setting(),
        {"resume", "", "continue the interrupted run in the folder given by --out", true},
        {"seed", "", "seed of the random numbers [the experiment's]"},
        {"threads", "", "threads [the experiment's; 0 takes all]"},
        pictures_setting(),
        set_setting(),
    };
    for (Setting flag : model_settings()) { // for all experiments with a model
        flag.fallback = "";
        flag.meaning = "replaces model." + flag.name + " of the file: " + flag.meaning;
        settings.push_back(flag);
    }
    return settings;
}

/// The experiment of the file's experiment.kind. Its other keys are not known before.
const Experiment& experiment_of(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    std::vector<std::string> kinds;
    for (const Experiment& experiment : experiments()) kinds.push_back(experiment.kind);
    const Setting kind{"experiment.kind", "paper", ""};
    return experiments()[read_ini(file, {kind, {"*", "", ""}}, overrides).one_of(kind.name, kinds)];
}

/// Runs an experiment under its short name: the keys of the section with that name are flags.
int run_by_name(const Experiment& experiment, const Settings& given, const std::string& line) {
    const std::string& kind = experiment.kind;
    std::vector<std::string> overrides = given.words("set");
    for (const auto& [flag, value] : given.values())
        if (flag != "out" && flag != "force" && flag != "experiment" && flag != "set") {
            const bool is_common = flag == "seed" || flag == "threads";
            overrides.push_back((is_common ? "experiment." : kind + ".") + flag + "=" + value);
        }
    const bool has_file = experiment.takes_file && given.has("experiment");
    const Settings settings = read_ini(has_file ? given.text("experiment") : "", experiment.all_settings(), overrides);
    if (has_file && settings.text("experiment.kind") != kind)
        settings.refuse("experiment.kind", settings.text("experiment.kind"), " given; give ", kind);
    return carry_out(experiment, settings, {line, given, kind, experiment.takes_file ? "report.html" : kind + ".html"});
}

int run(const Settings& flags, const std::string& line) {
    if (!flags.has("experiment")) rough::refuse("run: no experiment given; name an .ini file");
    std::vector<std::string> overrides = flags.words("set");
    for (const char* key : {"seed", "threads"})
        if (flags.has(key)) overrides.push_back(std::string("experiment.") + key + "=" + flags.text(key));
    for (const Setting& flag : model_settings())
        if (flags.given(flag.name)) overrides.push_back("model." + flag.name + "=" + flags.text(flag.name));

    const std::filesystem::path file = flags.text("experiment");
    const Experiment& experiment = experiment_of(file, overrides);
    const Settings settings = read_ini(file, experiment.all_settings(), overrides);
    return carry_out(experiment, settings, {line, flags, file.stem().string(), "report.html"});
}

} // namespace

Command short_command(const std::string& kind) {
    const Experiment& experiment = experiment_named(kind);
    std::vector<Setting> flags{{"out", "", "folder to write [out/" + kind + "]"}, force_setting(), set_setting()};
    if (experiment.takes_file) {
        flags.push_back({"experiment", "", "an .ini file of this kind (may be given without the flag)"});
        for (Setting common : {seed_setting(), threads_setting()}) {
            common.fallback = "";
            common.meaning += " [the file's, or the default of the experiment]";
            flags.push_back(common);
        }
    }
    for (Setting key : experiment.settings)
        if (key.name.starts_with(kind + ".")) {
            key.name.erase(0, kind.size() + 1);
            flags.push_back(key);
        }
    return {kind, flags,
            [&](const Settings& given, const std::string& line) { return run_by_name(experiment, given, line); },
            experiment.takes_file ? Words{"experiment"} : Words{}};
}

Command run_command() { return {"run", run_settings(), run, {"experiment"}}; }

} // namespace app
