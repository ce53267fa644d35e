#include "apps/report/output.hpp"

#include "apps/prompt/voice.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace app {

namespace fs = std::filesystem;
using rough::InputError;

namespace {

fs::path first_free(const fs::path& wanted) {
    fs::path path = wanted;
    for (int number = 2; fs::exists(path); ++number)
        path = wanted.string() + "-" + std::to_string(number);
    return path;
}

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
        } else if (fs::exists(folder / name, error)) {
            all.push_back(folder / name);
        }
    return all;
}

} // namespace

OutputFolder::OutputFolder(const std::string& given, const std::string& name, const Writing& writing)
    : path_(given.empty() ? first_free(fs::path("out") / name) : fs::path(given)) {
    std::error_code error;
    for (const fs::path& file : present(path_, writing.names)) {
        if (is_among(file, writing.inputs))
            throw InputError("--out: " + file.string() +
                             " would be written over, and is read here; expected another folder");
        if (writing.force || writing.resume)
            continue;
        if (file.stem() == "checkpoint" || file.stem() == "checkpoints")
            throw InputError("--out: " + given +
                             " holds a run to go on with, expected --resume, another folder or --force");
        throw InputError("--out: " + given + " holds " + file.filename().string() +
                         " already, expected another folder or --force");
    }
    for (fs::path missing = path_; !missing.empty() && !fs::exists(missing, error);
         missing = missing.parent_path())
        made_.push_back(missing);
    fs::create_directories(path_, error);
    if (error || !fs::is_directory(path_))
        throw InputError("--out: " + path_.string() +
                         " cannot be made, expected a folder that can be written");
    const fs::path probe = path_ / ".writable";
    try {
        rough::write_atomically(probe, "");
    } catch (const InputError&) {
        throw InputError("--out: " + path_.string() + " cannot be written, expected a folder that can be");
    }
    fs::remove(probe, error);
}

OutputFolder::~OutputFolder() {
    std::error_code not_empty;
    for (const fs::path& folder : made_)
        fs::remove(folder, not_empty);
}

bool says_finished(const fs::path& folder, const std::string& checkpoint) {
    if (!fs::exists(folder / "result.json") || fs::exists(folder / checkpoint))
        return false;
    say(folder.string() + ": was finished, nothing is left to go on with; another set-up takes --force");
    return true;
}

void write_json(const fs::path& file, const nlohmann::json& content) {
    rough::write_atomically(file, rough::json_text(content) + "\n");
}

void expect_writable(const fs::path& file, const Settings& settings) {
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
}

} // namespace app
