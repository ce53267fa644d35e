#include "domain/text/json.hpp"

#include "domain/errors.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rough {

std::string json_text(const nlohmann::json& value, bool one_line) {
    return value.dump(one_line ? -1 : 1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json parsed_json(std::string_view text, const std::string& where) {
    constexpr int max_depth = 64; // brackets; code that visits a value recurses once per level
    using Event = nlohmann::json::parse_event_t;
    const auto expect_shallow = [&](int depth, Event event, const nlohmann::json&) {
        if (depth >= max_depth && (event == Event::object_start || event == Event::array_start))
            throw InputError(where + ": brackets are more than " + std::to_string(max_depth) +
                             " deep; nest fewer");
        return true;
    };
    try {
        return nlohmann::json::parse(text, expect_shallow);
    } catch (const nlohmann::json::exception& error) {
        std::string detail = error.what(); // "[json.exception.parse_error.101] parse error at line 1, …"
        std::replace(detail.begin(), detail.end(), '\n', ' ');
        throw InputError(where + ": not JSON (" +
                         detail.substr(std::min(detail.find(']') + 2, detail.size())) + "); correct it");
    }
}

} // namespace rough
