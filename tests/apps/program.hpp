#pragma once

#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sys/wait.h>

namespace app::testing {

using tests::Folder;

struct Ended {
    int code;
    std::string out, err;
    double seconds; ///< wall time
    long error_lines() const { return std::ranges::count(err, '\n'); }
};

/// Requires exit code 2 and one line that contains `words`.
inline void check_refused(const Ended& ended, const std::string& words) {
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK(ended.error_lines() == 1);
    CHECK_THAT(ended.err, Catch::Contains(words));
}

/// Checks that the values of each page that was written since a time have every key that its template names.
inline void check_pages(const std::filesystem::path& where, std::filesystem::file_time_type since) {
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             where, std::filesystem::directory_options::skip_permission_denied, none)) {
        const std::filesystem::path page = entry.path();
        if (page.extension() != ".html" || !entry.is_regular_file(none) || entry.last_write_time(none) < since)
            continue;
        auto place = page;
        if (!std::filesystem::is_regular_file(place.replace_extension(".json"), none)) place = page.parent_path();
        std::set<std::string> missing;
        try {
            render(page_source(place), {.seconds = 0, .missing = &missing});
        } catch (const rough::InputError&) {
            continue; // another kind of page
        }
        INFO(page.string());
        CHECK(missing == std::set<std::string>());
    }
}

constexpr int killed = 128 + SIGKILL; ///< exit code of a killed program

/// Runs the built program in a folder by a shell, after the words `by`, e.g. "timeout -s KILL 0.1".
inline Ended rugosa(const std::string& words, const std::filesystem::path& where, const std::string& by = "") {
    const Folder logs;
    const std::string command = "cd '" + where.string() + "' && " + by + " '" RUGOSA_PROGRAM "' " + words + " >'" +
                                (logs / "out").string() + "' 2>'" + (logs / "err").string() + "' </dev/null";
    const auto started = std::filesystem::file_time_type::clock::now();
    const auto start = std::chrono::steady_clock::now();
    const int status = std::system(command.c_str());
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    INFO(words);
    CHECK((code == 0 || code == 2 || code == 3 || code == 130 || code == killed)); // no other is documented
    check_pages(where, started);
    return {code, rough::read_whole(logs / "out"), rough::read_whole(logs / "err"), passed.count()};
}

/// Requires exit code 0.
inline Ended succeeded(Ended ended) {
    INFO(ended.out << ended.err);
    REQUIRE(ended.code == 0);
    return ended;
}
/// Runs the program in a folder and requires exit code 0.
inline Ended done(const Folder& folder, const std::string& words) { return succeeded(rugosa(words, folder.path())); }
/// Requires exit code 0, or 3 of a design whose answer is not as similar as required.
inline Ended answered(Ended ended) {
    INFO(ended.out << ended.err);
    REQUIRE((ended.code == 0 || ended.code == 3));
    return ended;
}

/// Runs the program in an empty folder.
inline Ended rugosa(const std::string& words) { return rugosa(words, Folder().path()); }

/// Runs the program after the words `by`, and the shell's `commands` as soon as its condition `sign` holds.
/// To them the program is $child.
inline Ended disturbed(const std::string& words, const std::filesystem::path& where, const std::string& sign,
                       const std::string& commands, const std::string& by = "") {
    const Folder logs;
    const auto script = logs.write(
        "disturb.sh", "cd '" + where.string() + "'\n" + by + " '" RUGOSA_PROGRAM "' " + words + " >'" +
                          (logs / "out").string() + "' 2>'" + (logs / "err").string() + "' & child=$!\nuntil " + sign +
                          " || ! kill -0 $child; do sleep 0.002; done\n" + commands + "; wait $child\n");
    const int status = std::system(("bash '" + script.string() + "' 2>/dev/null").c_str());
    return {WEXITSTATUS(status), rough::read_whole(logs / "out"), rough::read_whole(logs / "err"), 0};
}
/// Asks it to stop `seconds` after the folder or non-empty file `sign` has appeared.
inline Ended rugosa_stopped(double seconds, const std::string& sign, const std::string& words,
                            const std::filesystem::path& where) {
    return disturbed(words, where, "[ -d " + sign + " ] || [ -s " + sign + " ]",
                     "sleep " + std::to_string(seconds) + "; kill -TERM $child");
}

} // namespace app::testing
