#include "apps/target_files.hpp"

#include "domain/errors.hpp"
#include "domain/text/words.hpp"

namespace app {

std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name) {
    const std::string all = settings.path(name).string();
    // What settings.path puts before the names, where the experiment's file gives them.
    const std::filesystem::path beside = all.substr(0, all.size() - settings.text(name).size());
    std::vector<std::filesystem::path> files;
    for (const std::string& file : rough::listed(settings.text(name)))
        files.push_back(beside / file);
    if (files.empty())
        throw rough::InputError(settings.place(name) + ": none given, expected target files (CSV)");
    return files;
}

} // namespace app
