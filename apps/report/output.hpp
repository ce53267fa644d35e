#pragma once

#include "apps/prompt/settings.hpp"

#include <nlohmann/json_fwd.hpp>

namespace app {

/// Files that a run writes to its folder, and what it may overwrite.
struct Writing {
    std::vector<std::string> names;            ///< names in the folder
    std::vector<std::filesystem::path> inputs; ///< files that the command reads, which are never overwritten
    bool force = false;                        ///< whether other files may be overwritten
    bool resume = false;                       ///< whether those of the resumed run may be
};

/// The folder of a run's results: --out or, by default, out/NAME below the working directory, or out/NAME-2
/// and so on if that exists. No other run can use it while this object lives. Throws rough::InputError if the
/// folder cannot be made or written, is in use, or has a file that would be lost. Symbolic links among the
/// files to write are never followed: --force removes them. The destructor removes folders that stayed empty.
class OutputFolder {
  public:
    OutputFolder(const std::string& given, const std::string& name, const Writing& writing);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The path of the folder. While this object lives, its files are those of the locked folder, even if
    /// another one, or a link, is at its path. It is made again if it was removed during the run.
    const std::filesystem::path& restored() const;

  private:
    OutputFolder() = default; // delegated to, so that the destructor runs if the constructor throws
    void make(const std::string& given, const std::string& name);
    void lock();
    void expect_free(const Writing& writing) const;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_; ///< innermost first
    int locked_ = -1;                         ///< a descriptor of the folder
};

/// Names of files and fingerprints of their contents, as `inputs` of result.json.
nlohmann::json inputs_json(const std::vector<std::filesystem::path>& files);
/// The fingerprints, which a resumed run must share.
std::string key_of(const nlohmann::json& inputs);

/// Whether a run is resumed. Throws rough::InputError if its folder is not named.
bool resumes(const Settings& settings);

/// Whether a folder holds a finished result, with no checkpoint to resume from. Prints a line if it does.
/// Throws rough::InputError if the result was made from other inputs.
bool says_finished(const std::filesystem::path& folder, const std::string& checkpoint, const nlohmann::json& inputs);

/// Minimum number of seconds between two checkpoints of a run: 1, or the variable RUGOSA_CHECKPOINTS of the
/// environment.
double checkpoint_interval();

/// Prints notes on files that could not be written, and with --verbose the engine's other notes.
void tell_notes(const std::vector<std::string>& notes);

/// Writes a JSON file whole or not at all. NaN becomes null.
void write_json(const std::filesystem::path& file, const nlohmann::json& content);

/// The path to write for a flag or a file next to it: the target of a symbolic link there. Throws
/// rough::InputError if its folder is missing, the command reads the file, or it exists without --force.
std::filesystem::path expect_writable(const std::filesystem::path& file, const Settings& settings,
                                      const std::string& flag = "--out");

} // namespace app
