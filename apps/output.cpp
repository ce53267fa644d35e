#include "apps/output.hpp"

#include "domain/atomic_file.hpp"
#include "domain/errors.hpp"

namespace app {

namespace fs = std::filesystem;
using rough::InputError;

namespace {

constexpr const char* result_name = "result.json";

fs::path first_free(const fs::path& wanted) {
    fs::path path = wanted;
    for (int number = 2; fs::exists(path); ++number)
        path = wanted.string() + "-" + std::to_string(number);
    return path;
}

} // namespace

fs::path output_folder(const std::string& given, const std::string& name, bool force) {
    const fs::path folder = given.empty() ? first_free(fs::path("out") / name) : fs::path(given);
    std::error_code error;
    if (!given.empty() && fs::exists(folder / result_name, error) && !force)
        throw InputError("--out: " + given + " holds a result, expected another folder or --force");
    const bool made = fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw InputError("--out: " + folder.string() +
                         " cannot be made, expected a folder that can be written");
    const fs::path probe = folder / ".writable";
    try {
        rough::write_atomically(probe, "");
    } catch (const InputError&) {
        if (made)
            fs::remove(folder, error);
        throw InputError("--out: " + folder.string() + " cannot be written, expected a folder that can be");
    }
    fs::remove(probe, error);
    return folder;
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
