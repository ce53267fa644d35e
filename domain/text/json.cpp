#include "domain/text/json.hpp"

#include "domain/errors.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rough {
namespace {

constexpr int deepest = 64;

/// Brackets are counted before anything is built of them: what walks a value recurses once a level.
void expect_shallow(std::string_view text, const std::string& where) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > deepest)
            throw InputError(where + ": brackets more than " + std::to_string(deepest) +
                             " deep, expected fewer");
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
}

} // namespace

std::string json_text(const nlohmann::json& value, bool one_line) {
    return value.dump(one_line ? -1 : 1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json parsed_json(std::string_view text, const std::string& where) {
    expect_shallow(text, where);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        std::string detail = error.what(); // "[json.exception.parse_error.101] parse error at line 1, …"
        std::replace(detail.begin(), detail.end(), '\n', ' ');
        throw InputError(where +
                         ": not JSON: " + detail.substr(std::min(detail.find(']') + 2, detail.size())));
    }
}

} // namespace rough
