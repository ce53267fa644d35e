#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unistd.h>

namespace ga {

/// @cond
inline std::map<std::string, int>& held_folders() {
    static std::map<std::string, int> all; // changed only while nothing is written
    return all;
}
/// @endcond

/// From now on, held() finds files of a folder by its open descriptor, whatever is at its name by then.
inline void hold_folder(const std::filesystem::path& folder, int descriptor) {
    held_folders()[(folder / "").string()] = descriptor;
}
/// Ends that.
inline void release_folder(const std::filesystem::path& folder) {
    held_folders().erase((folder / "").string());
}

/// The place of a file: if its folder is held, a path that leads through the descriptor, also for a child
/// process, else its name.
inline std::filesystem::path held(const std::filesystem::path& file) {
    const std::string name = file.string();
    for (const auto& [folder, descriptor] : held_folders())
        if (name.starts_with(folder))
            return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor) + "/" +
                   name.substr(folder.size());
    return file;
}

} // namespace ga
