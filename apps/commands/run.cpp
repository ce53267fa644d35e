#include "apps/commands/commands.hpp"
#include "apps/experiments/accuracy/experiment.hpp"
#include "apps/experiments/paper/experiment.hpp"
#include "apps/experiments/paper/page.hpp"
#include "apps/experiments/paper/settings.hpp"
#include "apps/experiments/paper/tables.hpp"
#include "apps/experiments/variants/experiment.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

/// The model's settings, as flags of every experiment.
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
        {"resume", "", "go on with an interrupted run in the folder given by --out", true},
        {"seed", "", "seed of everything random [the experiment's]"},
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

nlohmann::json result_json(const PaperRun& run, const TargetRun& target) {
    nlohmann::json result = head_json(run.searched, {run.version, run.command, run.seed, run.threads});
    result["max_pressure_MPa"] = run.max_pressure;
    result["threshold_MPa"] = target.p_bar;
    result["target"] = target_json(target.target);
    for (const VariantRun& variant : target.variants)
        result["variants"][variant.name] = variant_json(variant, {run.searched});
    return result;
}

enum class Kind { paper, variants, accuracy };

/// What the experiment is of, before its keys are known.
Kind kind_of(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    const std::vector<Setting> any =
        joined({paper_settings(),
                variants_settings(),
                accuracy_study_settings(),
                {{"experiment.*", "", ""}, {"targets.*", "", ""}, {"variants.*", "", ""}}});
    return static_cast<Kind>(
        read_ini(file, any, overrides).one_of("experiment.kind", {"paper", "variants", "accuracy"}));
}

std::vector<std::filesystem::path> inputs_of(const Settings& flags, const Settings& experiment) {
    std::vector<std::filesystem::path> inputs = flags.files();
    for (const auto& file : experiment.files())
        inputs.push_back(file);
    return inputs;
}

/// An experiment without checkpoints: what it gives is written as it ends, or as far as it came.
template <class Run, class Write, class Page>
int run_at_once(const Words& given, const Settings& flags, const std::vector<Setting>& known,
                const std::vector<std::string>& overrides, Run work, Write write, Page page,
                const std::vector<std::string>& names) {
    const std::filesystem::path file = flags.text("experiment");
    const Settings settings = read_ini(file, known, overrides);
    if (flags.is_on("resume"))
        throw rough::InputError("--resume: given with an experiment of kind " +
                                settings.text("experiment.kind") + ", which keeps no checkpoints");
    const OutputFolder output(flags.text("out"), file.stem().string(),
                              {names, inputs_of(flags, settings), flags.is_on("force")});
    const Interrupt interrupt;
    Progress progress;
    auto result = work(settings, progress, interrupt.flag());
    result.version = RUGOSA_VERSION;
    result.command = command_line("run", given);
    write(result, output.path());
    if (flags.one_of("pictures", {"on", "off"}) == 0)
        rough::write_atomically(output.path() / "report.html", page(result));
    say(output.path().string() + ": " + readable(result.seconds) + " s");
    return interrupt.asked() ? exit_interrupted : 0;
}

} // namespace

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
    const Kind kind = kind_of(file, overrides);
    if (kind == Kind::variants)
        return run_at_once(given, flags, variants_settings(), overrides, run_race, write_race, race_page,
                           {"result.json", "variants.csv", "report.html"});
    if (kind == Kind::accuracy)
        return run_at_once(given, flags, accuracy_study_settings(), overrides, run_accuracy_study,
                           write_accuracy_study, accuracy_page,
                           {"result.json", "savings.csv", "searches.csv", "budget.csv", "report.html"});
    const Settings settings = read_ini(file, paper_settings(), overrides);
    const bool resume = flags.is_on("resume");
    if (resume && !flags.has("out"))
        throw rough::InputError(
            "--resume: given without --out, expected the folder of the run to go on with");
    const OutputFolder output(flags.text("out"), file.stem().string(),
                              {{"result.json", "report.html", "genomes.csv", "scores.csv", "stages.csv",
                                "curves.csv", "thresholds.csv", "heldout", "log", "checkpoints"},
                               inputs_of(flags, settings),
                               flags.is_on("force"),
                               resume});
    const auto& folder = output.path();
    if (resume && says_finished(folder, "checkpoints"))
        return 0;
    const Interrupt interrupt;
    Progress progress;
    PaperRun paper = run_paper(settings, progress, interrupt.flag(), {folder, resume});
    paper.version = RUGOSA_VERSION;
    paper.command = command_line("run", given);

    for (const TargetRun& target : paper.targets) {
        const auto place = &target == &paper.targets.front() ? folder : folder / "heldout";
        std::filesystem::create_directories(place);
        write_target_tables(target, place);
        write_json(place / "result.json", result_json(paper, target));
    }
    write_database_table(paper, folder);
    if (interrupt.asked()) {
        say(folder.string() + ": interrupted; what was found is in result.json; --resume goes on");
        return exit_interrupted;
    }
    if (flags.one_of("pictures", {"on", "off"}) == 0)
        rough::write_atomically(folder / "report.html", paper_page(paper));
    std::filesystem::remove_all(folder / "checkpoints");
    say(folder.string() + ": " + readable(paper.seconds) + " s");
    return 0;
}

} // namespace app
