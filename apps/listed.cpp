#include "apps/listed.hpp"

#include "domain/errors.hpp"

#include <sstream>

namespace app {

std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');) {
        const auto from = part.find_first_not_of(" \t"), to = part.find_last_not_of(" \t");
        parts.push_back(from == std::string::npos ? "" : part.substr(from, to - from + 1));
    }
    return parts;
}

std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name) {
    const std::string all = settings.path(name).string();
    // What settings.path puts before the names, where the experiment's file gives them.
    const std::filesystem::path beside = all.substr(0, all.size() - settings.text(name).size());
    std::vector<std::filesystem::path> files;
    for (const std::string& file : listed(settings.text(name)))
        files.push_back(beside / file);
    if (files.empty())
        throw rough::InputError(settings.place(name) + ": none given, expected target files (CSV)");
    return files;
}

} // namespace app
