#pragma once

#include "domain/atomic_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace app::testing {

/// A folder of its own that goes with the test.
class Folder {
  public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "rugosa-test-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        rough::write_atomically(path_ / name, content);
        return path_ / name;
    }
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            names.push_back(entry.path().filename().string());
        return names;
    }

  private:
    std::filesystem::path path_;
};

struct Ended {
    int code;
    std::string out, err;
    long error_lines() const { return std::count(err.begin(), err.end(), '\n'); }
};

/// Runs the built program in a folder, as a shell would.
inline Ended rugosa(const std::string& words,
                    const std::filesystem::path& where = std::filesystem::temp_directory_path()) {
    const Folder logs;
    const std::string command = "cd '" + where.string() + "' && '" RUGOSA_PROGRAM "' " + words + " >'" +
                                (logs / "out").string() + "' 2>'" + (logs / "err").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), rough::read_whole(logs / "out"),
            rough::read_whole(logs / "err")};
}

} // namespace app::testing
