#pragma once

#include "apps/prompt/settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/record.hpp"
#include "ga/base/stopwatch.hpp"

#include <atomic>
#include <filesystem>
#include <map>

namespace app {

/// Under what an experiment runs.
struct Conditions {
    Origin origin;
    Progress& progress;
    const std::atomic<bool>& stop; ///< somebody asks it to end, with what was found so far
    std::filesystem::path folder;  ///< its results go there
    bool resume = false;           ///< go on from the checkpoints that are there
    std::string settings = {};     ///< those given, in one text; threads left out, as they change nothing
    ga::Stopwatch clock = {};      ///< since it began
};

/// What an experiment found.
struct Findings {
    nlohmann::json result = {}; ///< of result.json, which the run's origin joins; null: nothing was found
    std::map<std::string, std::string> files = {}; ///< tables and other files by name, a folder before it
    std::string summary = {};                      ///< in one line, for the end
    int code = 0;                                  ///< exit code of the program
};

/// A kind of experiment.
struct Experiment {
    std::string kind; ///< as in `experiment.kind = paper`
    std::string summary;
    std::vector<Setting> settings;  ///< its keys, without the common ones
    std::vector<std::string> files; ///< that it writes beside result.json and its page
    Findings (*run)(const Settings& settings, const Conditions& conditions);
    bool resumes = false;                   ///< it keeps checkpoints in the folder `checkpoints`
    std::vector<std::string> examples = {}; ///< flags of its short name, where it has one
    /// Its short name may be followed by an .ini file, has --seed and --threads, and writes report.html.
    bool takes_file = false;

    std::vector<Setting> all_settings() const; ///< with the common keys of the section [experiment]
};

Experiment paper_experiment();
Experiment variants_experiment();
Experiment accuracy_experiment();
Experiment chart_experiment();
Experiment stability_experiment();
Experiment compare_experiment();
Experiment readings_experiment();
Experiment features_experiment();
Experiment statistical_experiment();

/// Every kind.
const std::vector<Experiment>& experiments();

/// How a run was asked for.
struct Request {
    std::string command;                       ///< as it was typed
    std::string out, name;                     ///< --out or, without it, the name of a folder in out/
    std::vector<std::filesystem::path> inputs; ///< files that are not to be written over
    std::string page;                          ///< its file's name
    bool pictures = true, force = false, resume = false;
};

/// Writes result.json and the other files of an experiment to its folder.
void write(Findings& found, const Origin& origin, const std::filesystem::path& folder);

/// Runs an experiment and writes what it finds; returns the program's exit code.
int carry_out(const Experiment& experiment, const Settings& settings, const Request& request);

} // namespace app
