#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rough {

/// A value as JSON text, each level indented by a space, or on one line. Names of files and variants may hold
/// bytes that are no UTF-8: these become U+FFFD, as JSON has no other bytes.
std::string json_text(const nlohmann::json& value, bool one_line = false);

} // namespace rough
