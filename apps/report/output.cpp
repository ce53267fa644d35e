#include "apps/report/output.hpp"

#include "apps/prompt/terminal.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/base/held_folder.hpp"
#include "ga/base/json.hpp"
#include "ga/problem/fingerprint.hpp"

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>

namespace app {

namespace fs = std::filesystem;
using rough::refuse;

namespace {

bool is_among(const fs::path& file, const std::vector<fs::path>& files) {
    std::error_code error;
    return std::ranges::any_of(files, [&](const fs::path& other) { return fs::equivalent(file, other, error); });
}

/// The files in the folder that have these names.
std::vector<fs::path> present(const fs::path& folder, const std::vector<std::string>& names) {
    std::vector<fs::path> all;
    std::error_code error;
    for (const std::string& name : names)
        if (fs::exists(fs::symlink_status(folder / name, error))) // also a link to nothing
            all.push_back(folder / name);
    return all;
}

} // namespace

OutputFolder::OutputFolder(const std::string& given, const std::string& name, const Writing& writing) : OutputFolder() {
    make(given, name);
    lock();
    expect_free(writing);
    std::error_code error;
    for (const fs::path& file : present(path_, writing.names))
        if (fs::is_symlink(file, error)) fs::remove(file, error);
}

void OutputFolder::expect_free(const Writing& writing) const {
    std::error_code error;
    for (const fs::path& file : present(path_, writing.names)) {
        if (is_among(file, writing.inputs))
            refuse("--out: ", file.string(), " is read here and would be overwritten; choose another folder");
        if (fs::is_symlink(file, error) && !writing.force)
            refuse("--out: ", file.string(), " is a symbolic link; choose another folder, or remove it with --force");
        if (writing.force || writing.resume) continue;
        if (file.stem() == "checkpoint" || file.stem() == "checkpoints")
            refuse("--out: ", path_.string(),
                   " holds an interrupted run; set --resume, choose another folder or set --force");
        refuse("--out: ", path_.string(), " already holds ", file.filename().string(),
               "; choose another folder or set --force");
    }
}

void OutputFolder::make(const std::string& given, const std::string& name) {
    std::error_code error;
    const auto make_all = [&](const fs::path& folder) {
        fs::path path;
        for (const fs::path& part : folder)
            if (path /= part; !part.empty() && fs::create_directory(path, error)) made_.insert(made_.begin(), path);
    };
    if (!given.empty()) {
        path_ = given;
        make_all(path_);
    } else {
        if (name.empty() || name == "." || name == "..")
            refuse("--out: not given, and '", name, "' is not a folder name; set it");
        make_all("out");
        // The run that makes a folder has it: two runs that begin at once get two folders.
        path_ = fs::path("out") / name;
        for (int number = 2; !fs::create_directory(path_, error) && !error; ++number)
            path_ = "out/" + name + "-" + std::to_string(number);
        if (!error) made_.insert(made_.begin(), path_);
    }
    if (error || !fs::is_directory(path_, error))
        refuse("--out: ", path_.string(), " cannot be made; choose another folder");
    if (access(path_.c_str(), W_OK | X_OK) != 0)
        refuse("--out: ", path_.string(), " cannot be written; choose another folder");
}

/// Locks the folder itself by the kernel, until the process ends.
void OutputFolder::lock() {
    locked_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto is_taken = [&] {
        return locked_ >= 0 && flock(locked_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    };
    // A run that was just killed may take a moment to end.
    for (int tries = 0; tries < 40 && is_taken(); ++tries) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (is_taken()) refuse("--out: ", path_.string(), " is in use by another run; choose another folder, or wait");
    if (locked_ >= 0)
        if (::access("/proc/self/fd", X_OK) == 0) // without /proc, as in a bare chroot, by its name
            ga::hold_folder(path_, locked_);
}

OutputFolder::~OutputFolder() {
    ga::release_folder(path_);
    if (locked_ >= 0) close(locked_);
    std::error_code not_empty;
    for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

const fs::path& OutputFolder::restored() const {
    struct stat held {};
    struct stat there {};
    std::error_code error;
    if (fstat(locked_, &held) != 0) return path_;
    if (held.st_nlink == 0) {
        fs::create_directories(path_, error);
        const int fresh = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (fresh >= 0 && dup3(fresh, locked_, O_CLOEXEC) >= 0 && close(fresh) == 0)
            say("note: " + path_.string() + " was removed during the run; the results are in a new one");
    } else if (stat(path_.c_str(), &there) != 0 || there.st_ino != held.st_ino || there.st_dev != held.st_dev) {
        say("note: " + path_.string() + " was moved during the run; the results are in " +
            fs::read_symlink("/proc/self/fd/" + std::to_string(locked_), error).string());
    }
    return path_;
}

nlohmann::json inputs_json(const std::vector<fs::path>& files) {
    const auto hexadecimal = [](const ga::Fingerprint& print) {
        char text[33];
        std::snprintf(text, sizeof text, "%016" PRIx64 "%016" PRIx64, print.high, print.low);
        return std::string(text);
    };
    auto inputs = nlohmann::json::array();
    std::string piece(1 << 20, '\0');
    for (const fs::path& file : files) {
        std::ifstream in(file, std::ios::binary);
        std::string prints;
        while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0)
            prints += hexadecimal(ga::fingerprint(piece.data(), static_cast<std::size_t>(in.gcount())));
        inputs.push_back(
            {{"file", file.string()}, {"fingerprint", hexadecimal(ga::fingerprint(std::string_view(prints)))}});
    }
    return inputs;
}

std::string key_of(const nlohmann::json& inputs) {
    std::string key;
    for (const nlohmann::json& input : inputs)
        key += input.is_object() ? rough::json_text(input.value("fingerprint", nlohmann::json()), true) : "?";
    return key;
}

bool resumes(const Settings& settings) {
    const bool resume = settings.is_on("resume");
    if (resume && !settings.has("out")) refuse("--resume: given without --out; name the folder of the interrupted run");
    return resume;
}

bool says_finished(const fs::path& folder, const std::string& checkpoint, const nlohmann::json& inputs) {
    const fs::path file = folder / "result.json";
    if (!fs::exists(file) || fs::exists(folder / checkpoint)) return false;
    const auto result = rough::parsed_json(rough::read_whole(file), file.string());
    if (!result.is_object() || key_of(result.value("inputs", nlohmann::json())) != key_of(inputs))
        refuse(file.string(), ": made from other input files; give the same ones, or start again with --force");
    say(folder.string() + ": the run is finished and needs no --resume; --force restarts it");
    return true;
}

double checkpoint_interval() {
    const char* const given = std::getenv("RUGOSA_CHECKPOINTS");
    const double seconds = given ? rough::number_from(given, "RUGOSA_CHECKPOINTS") : 1;
    if (seconds < 0) refuse("RUGOSA_CHECKPOINTS: '", given, "' given; give 0 seconds or more");
    return seconds;
}

void tell_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
        (note.starts_with("checkpoint ") || note.starts_with("log ") ? say : tell)("note: " + note);
}

void write_json(const fs::path& file, const nlohmann::json& content) {
    rough::write_atomically(file, rough::json_text(content) + "\n");
}

fs::path expect_writable(const fs::path& file, const Settings& settings, const std::string& flag) {
    std::error_code error;
    if (fs::is_directory(file, error)) refuse(flag, ": ", file.string(), " is a folder; give the name of a file");
    if (is_among(file, settings.files()))
        refuse(flag, ": ", file.string(), " is read here and would be overwritten; choose another name");
    if (fs::is_regular_file(file, error) && !settings.is_on("force"))
        refuse(flag, ": ", file.string(), " exists; choose another name or set --force");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        refuse(flag, ": the folder ", folder.string(), " does not exist; make it or choose another");
    return fs::exists(file, error) && !fs::is_regular_file(file, error) ? file : rough::without_links(file);
}

} // namespace app
