#include "apps/report/output.hpp"

#include "apps/prompt/terminal.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <set>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace app {

namespace fs = std::filesystem;
using rough::InputError;

namespace {

bool is_among(const fs::path& file, const std::vector<fs::path>& files) {
    std::error_code error;
    return std::any_of(files.begin(), files.end(),
                       [&](const fs::path& other) { return fs::equivalent(file, other, error); });
}

/// Those that are there, of names in the folder.
std::vector<fs::path> present(const fs::path& folder, const std::vector<std::string>& names) {
    std::vector<fs::path> all;
    std::error_code error;
    for (const std::string& name : names)
        if (name.starts_with('*')) {
            for (const auto& entry : fs::directory_iterator(folder, error))
                if (entry.path().extension() == name.substr(1))
                    all.push_back(entry.path());
        } else if (fs::exists(fs::symlink_status(folder / name, error))) { // a link to nothing too
            all.push_back(folder / name);
        }
    return all;
}

} // namespace

OutputFolder::OutputFolder(const std::string& given, const std::string& name, const Writing& writing)
    : OutputFolder() {
    make(given, name);
    lock();
    expect_free(writing);
    std::error_code error;
    for (const fs::path& file : present(path_, writing.names))
        if (fs::is_symlink(file, error))
            fs::remove(file, error);
}

void OutputFolder::expect_free(const Writing& writing) const {
    std::error_code error;
    const std::string begins = "--out: " + path_.string();
    for (const fs::path& file : present(path_, writing.names)) {
        if (is_among(file, writing.inputs))
            throw InputError("--out: " + file.string() +
                             " would be written over, and is read here; expected another folder");
        if (fs::is_symlink(file, error) && !writing.force)
            throw InputError("--out: " + file.string() +
                             " is a link, expected another folder, or --force to take it away");
        if (writing.force || writing.resume)
            continue;
        if (file.stem() == "checkpoint" || file.stem() == "checkpoints")
            throw InputError(begins +
                             " holds an interrupted run, expected --resume, another folder or --force");
        throw InputError(begins + " holds " + file.filename().string() +
                         " already, expected another folder or --force");
    }
}

void OutputFolder::make(const std::string& given, const std::string& name) {
    std::error_code error;
    const auto make_all = [&](const fs::path& folder) {
        fs::path path;
        for (const fs::path& part : folder)
            if (path /= part; !part.empty() && fs::create_directory(path, error))
                made_.insert(made_.begin(), path);
    };
    if (!given.empty()) {
        path_ = given;
        make_all(path_);
    } else {
        if (name.empty() || name == "." || name == "..")
            throw InputError("--out: not given, and '" + name + "' names no folder; expected one");
        make_all("out");
        // Who makes a folder has it: two runs that begin at once take two.
        path_ = fs::path("out") / name;
        for (int number = 2; !fs::create_directory(path_, error) && !error; ++number)
            path_ = "out/" + name + "-" + std::to_string(number);
        if (!error)
            made_.insert(made_.begin(), path_);
    }
    if (error || !fs::is_directory(path_, error))
        throw InputError("--out: " + path_.string() +
                         " cannot be made, expected a folder that can be written");
    if (access(path_.c_str(), W_OK | X_OK) != 0)
        throw InputError("--out: " + path_.string() + " cannot be written, expected a folder that can be");
}

/// The kernel's lock on the folder itself: nothing is written, and it ends with the process whatever ends it.
void OutputFolder::lock() {
    locked_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto is_taken = [&] {
        return locked_ >= 0 && flock(locked_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    };
    // A run that was just killed may take a moment to end.
    for (int tries = 0; tries < 40 && is_taken(); ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (is_taken())
        throw InputError("--out: " + path_.string() +
                         " is in use by another run, expected another folder, or to wait for its end");
}

OutputFolder::~OutputFolder() {
    if (locked_ >= 0)
        close(locked_);
    std::error_code not_empty;
    for (const fs::path& folder : made_)
        fs::remove(folder, not_empty);
}

const fs::path& OutputFolder::restored() const {
    std::error_code error;
    if (!fs::exists(path_, error) && fs::create_directories(path_, error))
        say("note: " + path_.string() + " was taken away during the run; what was found is in a new one");
    return path_;
}

fs::path subfolder(const fs::path& folder, const std::string& name) {
    const fs::path path = folder / name;
    std::error_code error;
    if (!fs::is_symlink(path, error))
        fs::create_directory(path, error);
    if (fs::is_symlink(path, error) || !fs::is_directory(path, error))
        throw InputError(path.string() + ": is no folder of its own, expected one or nothing there");
    return path;
}

void expect_distinct(const std::vector<std::string>& names, const std::vector<std::string>& written,
                     const std::string& where) {
    std::set<std::string> seen(written.begin(), written.end());
    seen.insert({"", ".", ".."});
    for (const std::string& name : names)
        if (!seen.insert(name).second)
            throw InputError(where + ": '" + name +
                             "' given as a name, expected each once and none that the run itself takes");
}

bool says_finished(const fs::path& folder, const std::string& checkpoint) {
    if (!fs::exists(folder / "result.json") || fs::exists(folder / checkpoint))
        return false;
    say(folder.string() + ": is finished, there is nothing to resume; --force starts anew");
    return true;
}

double checkpoint_interval() {
    const char* const given = std::getenv("RUGOSA_CHECKPOINTS");
    if (!given)
        return 1;
    char* end = nullptr;
    const double seconds = std::strtod(given, &end);
    if (end == given || *end || !(seconds >= 0))
        throw InputError("RUGOSA_CHECKPOINTS: '" + std::string(given) +
                         "' given in the environment, expected seconds between two checkpoints");
    return seconds;
}

void tell_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
        (note.starts_with("checkpoint ") || note.starts_with("log ") ? say : tell)("note: " + note);
}

void write_json(const fs::path& file, const nlohmann::json& content) {
    rough::write_atomically(file, rough::json_text(content) + "\n");
}

fs::path expect_writable(const fs::path& file, const Settings& settings) {
    std::error_code error;
    if (fs::is_directory(file, error))
        throw InputError("--out: " + file.string() + " is a folder, expected a file");
    if (is_among(file, settings.files()))
        throw InputError("--out: " + file.string() +
                         " would be written over, and is read here; expected another name");
    if (fs::is_regular_file(file, error) && !settings.is_on("force"))
        throw InputError("--out: " + file.string() + " exists, expected another name or --force");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw InputError("--out: there is no folder " + folder.string() + ", expected one that exists");
    return fs::exists(file, error) && !fs::is_regular_file(file, error) ? file : rough::without_links(file);
}

} // namespace app
