#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace app {

/// Where a run's results go. Without a path given: out/NAME below the working directory, or out/NAME-2 and on
/// where that exists. A path given that holds a result (the file `mark`) is refused without `force`. Throws
/// rough::InputError, before any work is done, when the folder cannot be made or written. Folders made in
/// vain are taken away again.
class OutputFolder {
  public:
    OutputFolder(const std::string& given, const std::string& name, bool force,
                 const std::string& mark = "result.json");
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_; ///< the innermost first
};

/// Writes a JSON file whole or not at all. A number that is not known (NaN) is null in it.
void write_json(const std::filesystem::path& file, const nlohmann::json& content);

/// A file to write at an explicit place: its folder must exist, and it must not be there unless `force`.
void expect_writable(const std::filesystem::path& file, bool force);

} // namespace app
