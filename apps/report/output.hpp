#pragma once

#include "apps/prompt/settings.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace app {

/// Files to write, and what must not be lost for them.
struct Writing {
    std::vector<std::string> names;            ///< in the folder; "*.svg" is every picture
    std::vector<std::filesystem::path> inputs; ///< what the command reads: never written over
    bool force = false;                        ///< other files may be
    bool resume = false;                       ///< so may those of the run that is gone on with
};

/// Where a run's results go: --out or, without it, out/NAME below the working directory, or out/NAME-2 and on
/// where that exists. Throws rough::InputError, before any work is done, when the folder cannot be made or
/// written, or has a file that would be lost. Folders made in vain are taken away again.
class OutputFolder {
  public:
    OutputFolder(const std::string& given, const std::string& name, const Writing& writing);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_; ///< the innermost first
};

/// Whether a folder holds a result without the checkpoint to go on from; says so, as there is nothing to do.
bool says_finished(const std::filesystem::path& folder, const std::string& checkpoint);

/// Writes a JSON file whole or not at all. A number that is not known (NaN) is null in it.
void write_json(const std::filesystem::path& file, const nlohmann::json& content);

/// A file to write at an explicit place, --out or beside it: its folder must exist; it must not be there
/// unless --force, and be none that the command reads.
void expect_writable(const std::filesystem::path& file, const Settings& settings);

} // namespace app
