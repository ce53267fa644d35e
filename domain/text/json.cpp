#include "domain/text/json.hpp"

#include "domain/errors.hpp"
#include "ga/base/json.hpp"

#include <algorithm>

namespace rough {

std::string json_text(const nlohmann::json& value, bool one_line) {
    return value.dump(one_line ? -1 : 1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json parsed_json(std::string_view text, const std::string& where) {
    constexpr std::ptrdiff_t max_values = 3'000'000, nested = 3; // a value takes 16 bytes, nested ones more
    std::ptrdiff_t values = 0;
    for (const char c : text) values += c == ',' ? 1 : c == '{' || c == '[' ? nested : 0;
    if (values > max_values)
        throw InputError(where + ": more than 3 million values, of which arrays and objects count as 4; give fewer");
    try {
        if (auto read = ga::bounded_json(text); !read.is_discarded()) return read;
        throw InputError(where + ": brackets are more than 64 deep; nest fewer");
    } catch (const nlohmann::json::exception& error) {
        std::string detail = error.what(); // "[json.exception.parse_error.101] parse error at line 1, …"
        std::replace(detail.begin(), detail.end(), '\n', ' ');
        throw InputError(where + ": not JSON (" + detail.substr(std::min(detail.find(']') + 2, detail.size())) +
                         "); correct it");
    }
}

} // namespace rough
