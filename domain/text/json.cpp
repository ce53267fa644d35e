#include "domain/text/json.hpp"

#include <nlohmann/json.hpp>

namespace rough {

std::string json_text(const nlohmann::json& value, bool one_line) {
    return value.dump(one_line ? -1 : 1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace rough
