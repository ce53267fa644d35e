#include "apps/prompt/target_files.hpp"

#include "domain/errors.hpp"

namespace app {

std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name) {
    std::vector<std::filesystem::path> files = settings.paths(name);
    if (files.empty())
        throw rough::InputError(settings.place(name) + ": none given, expected target files (CSV)");
    return files;
}

} // namespace app
