#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace rough {

/// A value as JSON text, on one line or with a space per level. Bytes outside UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& value, bool one_line = false);

/// The value of a JSON text. Its brackets are at most 64 deep. It has at most 3 million values, of which
/// arrays and objects count as 4. Throws InputError that begins with `where` on any other text.
nlohmann::json parsed_json(std::string_view text, const std::string& where);

} // namespace rough
