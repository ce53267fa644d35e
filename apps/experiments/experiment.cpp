#include "apps/experiments/experiment.hpp"

#include "apps/prompt/units.hpp"
#include "apps/report/output.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/base/held_folder.hpp"

namespace app {

const Experiment& experiment_named(const std::string& kind) {
    return *std::ranges::find(experiments(), kind, &Experiment::kind);
}

std::vector<Setting> Experiment::all_settings() const {
    return joined({{{"experiment.kind", "paper", "kind of the experiment"},
                    whole("experiment.seed", "1", 0, 0x1p53,
                          "seed of the random numbers; the first one if each variant runs several times"),
                    whole("experiment.threads", "0", 0, 1024, "threads, unless times are measured; 0 takes all")},
                   settings});
}

namespace {

/// Makes a folder in a run's folder if it is missing. Throws rough::InputError on a symbolic link.
void make_folder(const std::filesystem::path& folder) {
    const std::filesystem::path path = ga::held_path(folder);
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) std::filesystem::create_directory(path, error);
    if (std::filesystem::is_symlink(path, error) || !std::filesystem::is_directory(path, error))
        rough::refuse(folder.string(), ": it is a file or symbolic link; remove it or choose another folder");
}

/// Writes result.json and the other files of an experiment to its folder.
void write(Findings& found, const Origin& origin, const std::filesystem::path& folder) {
    for (const auto& [name, table] : found.tables) found.files[name] = table.text();
    for (const auto& [name, text] : found.files) {
        if (const auto parent = std::filesystem::path(name).parent_path(); !parent.empty())
            make_folder(folder / parent);
        rough::write_atomically(folder / name, text);
    }
    found.result.update(origin_json(origin));
    write_json(folder / "result.json", found.result);
}

} // namespace

int carry_out(const Experiment& experiment, const Settings& settings, const Request& request) {
    const ga::Stopwatch clock;
    const Settings& flags = request.flags;
    const bool draws = !flags.knows("pictures") || flags.choice("pictures") == 0;
    const bool resume = flags.knows("resume") && resumes(flags);
    if (resume && !experiment.resumes)
        rough::refuse("--resume: experiments of kind ", experiment.kind, " do not write checkpoints; omit it");
    std::vector<std::string> names = experiment.files;
    names.insert(names.end(), {"result.json", request.page});
    if (experiment.resumes) names.emplace_back("checkpoints");
    std::vector<std::filesystem::path> inputs = settings.files();
    std::ranges::copy(flags.files(), std::back_inserter(inputs));
    const OutputFolder output(flags.text("out"), request.name, {names, inputs, flags.is_on("force"), resume});
    const std::filesystem::path& folder = output.path();
    const Origin origin{experiment.kind, request.command, settings.whole<std::uint64_t>("experiment.seed"),
                        ga::thread_count(settings.whole<int>("experiment.threads")), inputs_json(settings.files())};
    if (resume && says_finished(folder, "checkpoints", origin.inputs)) return 0;

    const Interrupt interrupt;
    Findings found;
    {
        ProgressLine progress;
        found = experiment.run(settings, {origin, progress, interrupt.flag(), folder, resume});
        output.restored();
        if (!found.result.is_null()) write(found, origin, folder);
        const bool goes_on = interrupt.requested() && experiment.resumes;
        if (!found.result.is_null() && draws && !goes_on) {
            progress.show("report");
            rough::write_atomically(folder / request.page, render(page_source(folder)));
        }
        if (experiment.resumes && !goes_on) std::filesystem::remove_all(ga::held_path(folder / "checkpoints"));
    }
    say(folder.string() + ": " +
        (found.result.is_null() ? "interrupted before the first result, nothing written"
         : interrupt.requested() && experiment.resumes
             ? "interrupted, the results so far are in result.json; --resume continues"
             : (found.summary.empty() ? "" : found.summary + "; ") + readable(clock.seconds()) + " s" +
                   (draws ? "; page " + (folder / request.page).string() : "")));
    return interrupt.requested() ? exit_interrupted : found.code;
}

} // namespace app
