#pragma once

#include "domain/atomic_file.hpp"
#include "tests/folder.hpp"

#include <algorithm>
#include <sys/wait.h>

namespace app::testing {

using tests::Folder;

struct Ended {
    int code;
    std::string out, err;
    long error_lines() const { return std::count(err.begin(), err.end(), '\n'); }
};

/// Runs the built program in a folder, as a shell would.
inline Ended rugosa(const std::string& words, const std::filesystem::path& where) {
    const Folder logs;
    const std::string command = "cd '" + where.string() + "' && '" RUGOSA_PROGRAM "' " + words + " >'" +
                                (logs / "out").string() + "' 2>'" + (logs / "err").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), rough::read_whole(logs / "out"),
            rough::read_whole(logs / "err")};
}

/// Runs it in an empty folder.
inline Ended rugosa(const std::string& words) { return rugosa(words, Folder().path()); }

} // namespace app::testing
