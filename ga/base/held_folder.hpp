#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unistd.h>

namespace ga {

/// @cond
inline std::map<std::string, int> held_folders; // changed only while nothing is written
/// @endcond

/// Makes held_path() find the files of a folder by its open descriptor, even if the folder's name changes.
inline void hold_folder(const std::filesystem::path& folder, int descriptor) {
    held_folders[(folder / "").string()] = descriptor;
}
/// Ends the effect of hold_folder().
inline void release_folder(const std::filesystem::path& folder) { held_folders.erase((folder / "").string()); }

/// The path of a file. If its folder is held, the path uses the descriptor and is also valid in a child
/// process. Otherwise it is the file's name.
inline std::filesystem::path held_path(const std::filesystem::path& file) {
    const std::string name = file.string();
    for (const auto& [folder, descriptor] : held_folders)
        if (name.starts_with(folder))
            return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor) + "/" +
                   name.substr(folder.size());
    return file;
}

} // namespace ga
