#pragma once

#include "apps/prompt/settings.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace app {

/// Files to write, and what must not be lost for them.
struct Writing {
    std::vector<std::string> names;            ///< in the folder; "*.x3p" is every file of that kind
    std::vector<std::filesystem::path> inputs; ///< what the command reads: never written over
    bool force = false;                        ///< other files may be
    bool resume = false;                       ///< so may those of the run that is gone on with
};

/// Where a run's results go: --out or, without it, out/NAME below the working directory, or out/NAME-2 and on
/// where that exists. It is this run's alone until the object goes. Throws rough::InputError, before any work
/// is done, when the folder cannot be made or written, is in use by another run, or has a file that would be
/// lost. A link among the files to write is never followed: --force takes it away. Folders made in vain are
/// taken away again.
class OutputFolder {
  public:
    OutputFolder(const std::string& given, const std::string& name, const Writing& writing);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The same, made anew where it was taken away during the run.
    const std::filesystem::path& restored() const;

  private:
    OutputFolder() = default; // what is thrown once it is made undoes it
    void make(const std::string& given, const std::string& name);
    void lock();
    void expect_free(const Writing& writing) const;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_; ///< the innermost first
    int locked_ = -1;                         ///< a descriptor of the folder
};

/// The folder of that name in a run's folder, made where it is missing. Throws rough::InputError on a link.
std::filesystem::path subfolder(const std::filesystem::path& folder, const std::string& name);

/// Names that are to be folders, or rows of a table: each once, none that leads elsewhere or is among those
/// that the run itself writes. Throws rough::InputError that begins with `where`.
void expect_distinct(const std::vector<std::string>& names, const std::vector<std::string>& written,
                     const std::string& where);

/// Whether a folder holds a result without the checkpoint to go on from; says so, as there is nothing to do.
bool says_finished(const std::filesystem::path& folder, const std::string& checkpoint);

/// Seconds between two checkpoints of a run, at least: 1, or what RUGOSA_CHECKPOINTS in the environment says.
double checkpoint_interval();

/// Tells what could not be kept on the way, and with --verbose the engine's other remarks.
void tell_notes(const std::vector<std::string>& notes);

/// Writes a JSON file whole or not at all. A number that is not known (NaN) is null in it.
void write_json(const std::filesystem::path& file, const nlohmann::json& content);

/// A file to write at an explicit place, --out or beside it: its folder must exist; it must not be there
/// unless --force, and be none that the command reads. Gives where to write: where a link there ends.
std::filesystem::path expect_writable(const std::filesystem::path& file, const Settings& settings);

} // namespace app
