#pragma once

#include "apps/cluster/cluster.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/record.hpp"

namespace app {

/// The circumstances of a run.
struct RunConditions {
    Origin origin;
    ProgressLine& progress;
    const std::atomic<bool>& stop; ///< true ends the run; results so far are kept
    std::filesystem::path folder;  ///< for the results
    bool resume = false;           ///< continue from the folder's checkpoints
};

/// Results of an experiment.
struct Findings {
    nlohmann::json result = {};                    ///< result.json without the run's origin; null without any results
    std::map<std::string, std::string> files = {}; ///< other files by name, perhaps with a folder
    std::string summary = {};                      ///< one line, shown at the end
    int code = 0;                                  ///< exit code of the program
    std::map<std::string, Csv> tables = {};        ///< tables with their file names, perhaps with a folder

    /// The table of a file; it is created by the first call.
    Csv& table(const std::string& name, const std::string& header, int digits = 17) {
        return tables.try_emplace(name, header, digits).first->second;
    }
};

/// A kind of experiment.
struct Experiment {
    std::string kind;               ///< as in `experiment.kind = paper`
    std::vector<Setting> settings;  ///< its keys, without the common ones
    std::vector<std::string> files; ///< written files, except result.json and the page
    Findings (*run)(const Settings& settings, const RunConditions& conditions);
    bool resumes = false; ///< writes checkpoints to the folder `checkpoints`
    /// The short command takes an .ini file, --seed and --threads, and writes report.html.
    bool takes_file = false;
    cluster::Work (*work)(const nlohmann::json& setting) = nullptr; ///< work of other ranks for it

    std::vector<Setting> all_settings() const; ///< with the common keys of the section [experiment]
};

/// All kinds of experiments: the results of all functions `Experiment NAME_experiment() {` in the folders of
/// experiments/, which CMake lists.
const std::vector<Experiment>& experiments();
const Experiment& experiment_named(const std::string& kind);

/// A requested run.
struct Request {
    std::string command;   ///< as typed
    const Settings& flags; ///< its flags: out, force and, unless the name is short, pictures and resume
    std::string name;      ///< folder in out/ if --out is not given
    std::string page;      ///< file name of the page
};

/// Runs an experiment and writes its results; returns the program's exit code.
int carry_out(const Experiment& experiment, const Settings& settings, const Request& request);

/// Runs an experiment that is a Python script: experiments/KIND/KIND.py, built into the program. It gets the
/// settings as JSON, and writes result.json and tables to the folder. Throws rough::InputError with the last
/// line of its errors if it fails.
Findings findings_of_script(const Settings& settings, const RunConditions& conditions);

} // namespace app
