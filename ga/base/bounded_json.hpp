#pragma once

#include <nlohmann/json.hpp>

#include <string_view>

namespace ga {

/// A value in JSON or CBOR, or a discarded one if its arrays and objects are more than 64 deep. Code that
/// visits a value recurses once per level. Throws nlohmann's exceptions on other bytes. (The callback of
/// nlohmann::json::parse takes quadratic time.)
inline nlohmann::json bounded_json(std::string_view bytes,
                                   nlohmann::json::input_format_t format = nlohmann::json::input_format_t::json) {
    /// Builds the value like nlohmann's reader, and counts the depth.
    struct Bounded : nlohmann::detail::json_sax_dom_parser<nlohmann::json> {
        using Base = nlohmann::detail::json_sax_dom_parser<nlohmann::json>;
        using Base::Base;
        std::size_t depth = 0;
        bool start_object(std::size_t n) { return ++depth <= 64 && Base::start_object(n); }
        bool start_array(std::size_t n) { return ++depth <= 64 && Base::start_array(n); }
        bool end_object() { return --depth, Base::end_object(); }
        bool end_array() { return --depth, Base::end_array(); }
    };
    nlohmann::json value;
    Bounded reader(value, true);
    if (!nlohmann::json::sax_parse(bytes, &reader, format)) value = nlohmann::json::value_t::discarded;
    return value;
}

} // namespace ga
