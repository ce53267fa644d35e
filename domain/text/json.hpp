#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace rough {

/// A value as JSON text, each level indented by a space, or on one line. Names of files and variants may hold
/// bytes that are no UTF-8: these become U+FFFD, as JSON has no other bytes.
std::string json_text(const nlohmann::json& value, bool one_line = false);

/// The value of a JSON text whose brackets stand at most 64 deep. Throws InputError that begins with `where`
/// on anything else.
nlohmann::json parsed_json(std::string_view text, const std::string& where);

} // namespace rough
