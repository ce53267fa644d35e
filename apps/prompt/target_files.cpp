#include "apps/prompt/target_files.hpp"

#include "domain/errors.hpp"

namespace app {

std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name) {
    std::vector<std::filesystem::path> files = settings.paths(name);
    if (files.empty())
        throw rough::InputError(settings.place(name) + ": none given, expected target files (CSV)");
    return files;
}

std::vector<rough::Target> named_targets(const Settings& settings, const std::string& name) {
    std::vector<rough::Target> targets;
    for (const auto& file : target_files(settings, name)) {
        targets.push_back(rough::read_target(file));
        targets.back().name = file.stem().string();
    }
    return targets;
}

} // namespace app
