#pragma once

#include "domain/text/atomic_file.hpp"

#include <nlohmann/json.hpp>

namespace app::testing {

/// What a run has left in its folder.
inline nlohmann::json result_in(const std::filesystem::path& folder) {
    return nlohmann::json::parse(rough::read_whole(folder / "result.json"));
}

/// Without what a clock or the command line decides.
inline nlohmann::json timeless(nlohmann::json result) {
    for (auto& variant : result["variants"])
        variant.erase("seconds");
    result.erase("threads");
    result.erase("command");
    return result;
}

} // namespace app::testing
