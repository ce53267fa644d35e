#include "apps/commands/commands.hpp"
#include "apps/experiments/experiment.hpp"
#include "apps/prompt/model_settings.hpp"
#include "domain/errors.hpp"

#include <algorithm>

namespace app {

namespace {

/// The model's settings, as flags of every experiment that has one.
std::vector<Setting> model_flags() {
    std::vector<Setting> flags = joined({model_settings(), {accuracy_setting()}});
    for (Setting& flag : flags)
        flag.fallback = "";
    return flags;
}

std::vector<Setting> run_settings() {
    std::vector<Setting> settings{
        {"experiment", "", "the experiment's .ini file (may be given without the flag)"},
        {"out", "", "folder for the results [out/NAME, or out/NAME-2 and on]"},
        {"force", "", "write over an existing result", true},
        {"resume", "", "continue the interrupted run in the folder given by --out", true},
        {"seed", "", "seed of the random numbers [the experiment's]"},
        {"threads", "", "threads [the experiment's; 0 takes all]"},
        {"pictures", "on", "off leaves out the report and its pictures"},
        {"set", "", "change a key of the experiment, section.key=value; may be repeated"},
    };
    for (Setting flag : model_flags()) {
        flag.meaning = "in place of the experiment's model." + flag.name + ": " + flag.meaning;
        settings.push_back(flag);
    }
    return settings;
}

/// Takes the repeatable `--set section.key=value` out of the words.
std::vector<std::string> taken_overrides(Words& words) {
    std::vector<std::string> overrides;
    for (std::size_t i = 0; i < words.size();)
        if (words[i] == "--set" && i + 1 < words.size()) {
            overrides.push_back(words[i + 1]);
            words.erase(words.begin() + static_cast<long>(i), words.begin() + static_cast<long>(i) + 2);
        } else if (words[i].starts_with("--set=")) {
            overrides.push_back(words[i].substr(6));
            words.erase(words.begin() + static_cast<long>(i));
        } else
            ++i;
    return overrides;
}

/// By the file's experiment.kind, which is read before it is known what other keys there may be.
const Experiment& experiment_of(const std::filesystem::path& file,
                                const std::vector<std::string>& overrides) {
    std::vector<std::string> kinds;
    std::vector<Setting> any;
    for (const Experiment& experiment : experiments()) {
        kinds.push_back(experiment.kind);
        for (const Setting& setting : experiment.all_settings()) {
            any.push_back(setting);
            any.push_back({setting.name.substr(0, setting.name.find('.')) + ".*", "", ""});
        }
    }
    return experiments()[read_ini(file, any, overrides).one_of("experiment.kind", kinds)];
}

/// Runs an experiment under its short name: the keys of its own section are flags.
int run_by_name(const std::string& kind, const Words& words) {
    const Experiment& experiment = *std::find_if(experiments().begin(), experiments().end(),
                                                 [&](const Experiment& one) { return one.kind == kind; });
    std::map<std::string, std::string> key_of; // by flag
    std::vector<Setting> flags{{"out", "", "folder to write [out/" + kind + "]"},
                               {"force", "", "write over an existing result", true}};
    if (experiment.takes_file) {
        flags.push_back({"experiment", "", "an .ini file of this kind (may be given without the flag)"});
        for (const char* common : {"seed", "threads"}) {
            key_of[common] = std::string("experiment.") + common;
            flags.push_back(
                {common, "", std::string(common) + " [the file's, or " + (common[0] == 's' ? "1]" : "all]")});
        }
    }
    for (const Setting& key : experiment.settings)
        if (key.name.starts_with(kind + ".")) {
            flags.push_back(key);
            flags.back().name = key.name.substr(kind.size() + 1);
            key_of[flags.back().name] = key.name;
        }
    if (shows_help(words, kind + (experiment.takes_file ? " [FILE.ini]" : "") + " [--out DIR] [flags]",
                   experiment.summary, flags, experiment.examples))
        return 0;
    const Settings given = read_command_line(words, flags,
                                             experiment.takes_file ? std::vector<std::string>{"experiment"}
                                                                   : std::vector<std::string>{});
    std::map<std::string, std::string> values;
    std::vector<std::string> overrides;
    for (const auto& [flag, key] : key_of)
        if (given.given(flag)) {
            values[key] = given.text(flag);
            overrides.push_back(key + "=" + given.text(flag));
        }
    Request request{.command = command_line(kind, words),
                    .out = given.text("out"),
                    .name = kind,
                    .inputs = given.files(),
                    .page = experiment.takes_file ? "report.html" : kind + ".html",
                    .force = given.is_on("force")};
    if (!experiment.takes_file || !given.has("experiment"))
        return carry_out(experiment, Settings("", experiment.all_settings(), values), request);
    const std::filesystem::path file = given.text("experiment");
    const Settings settings = read_ini(file, experiment.all_settings(), overrides);
    if (settings.text("experiment.kind") != kind)
        throw rough::InputError(settings.place("experiment.kind") + ": " + settings.text("experiment.kind") +
                                " given, expected " + kind);
    for (const auto& input : settings.files())
        request.inputs.push_back(input);
    return carry_out(experiment, settings, request);
}

} // namespace

int chart(const Words& words) { return run_by_name("chart", words); }
int compare(const Words& words) { return run_by_name("compare", words); }
int stability(const Words& words) { return run_by_name("stability", words); }

int run(const Words& given) {
    if (shows_help(given, "run EXPERIMENT.ini [--out DIR] [--set section.key=value]... [flags]",
                   "Runs an experiment and writes result.json, tables (CSV) and report.html to a folder. "
                   "--set changes one key of the experiment and may be repeated.",
                   run_settings(),
                   {"run experiments/paper.ini", "run experiments/paper.ini --out results --seed 7",
                    "run experiments/paper.ini --set target.profile=scan.txt --set target.unit=um"}))
        return 0;
    Words words = given;
    std::vector<std::string> overrides = taken_overrides(words);
    const Settings flags = read_command_line(words, run_settings(), {"experiment"});
    if (!flags.has("experiment"))
        throw rough::InputError("run: no experiment given, expected an .ini file");
    for (const char* key : {"seed", "threads"})
        if (flags.has(key))
            overrides.push_back(std::string("experiment.") + key + "=" + flags.text(key));
    for (const Setting& flag : model_flags())
        if (flags.has(flag.name))
            overrides.push_back("model." + flag.name + "=" + flags.text(flag.name));

    const std::filesystem::path file = flags.text("experiment");
    const Experiment& experiment = experiment_of(file, overrides);
    const Settings settings = read_ini(file, experiment.all_settings(), overrides);
    std::vector<std::filesystem::path> inputs = flags.files();
    for (const auto& input : settings.files())
        inputs.push_back(input);
    return carry_out(experiment, settings,
                     {.command = command_line("run", given),
                      .out = flags.text("out"),
                      .name = file.stem().string(),
                      .inputs = inputs,
                      .page = "report.html",
                      .pictures = flags.one_of("pictures", {"on", "off"}) == 0,
                      .force = flags.is_on("force"),
                      .resume = flags.is_on("resume")});
}

} // namespace app
