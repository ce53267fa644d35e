#include "apps/output.hpp"

#include "domain/atomic_file.hpp"
#include "domain/errors.hpp"

#include <nlohmann/json.hpp>

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

} // namespace

OutputFolder::OutputFolder(const std::string& given, const std::string& name, bool force,
                           const std::string& mark)
    : path_(given.empty() ? first_free(fs::path("out") / name) : fs::path(given)) {
    std::error_code error;
    if (!given.empty() && fs::exists(path_ / mark, error) && !force)
        throw InputError("--out: " + given + " holds a result, expected another folder or --force");
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

void write_json(const fs::path& file, const nlohmann::json& content) {
    rough::write_atomically(file, content.dump(1) + "\n");
}

void expect_writable(const fs::path& file, bool force) {
    std::error_code error;
    if (fs::is_directory(file, error))
        throw InputError("--out: " + file.string() + " is a folder, expected a file");
    if (fs::exists(file, error) && !force)
        throw InputError("--out: " + file.string() + " exists, expected another name or --force");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw InputError("--out: there is no folder " + folder.string() + ", expected one that exists");
}

} // namespace app
