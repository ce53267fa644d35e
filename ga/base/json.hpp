#pragma once

#include <nlohmann/json.hpp>

#include <concepts>
#include <string_view>
#include <utility>

/// @file
/// The only header that includes <nlohmann/json.hpp>. A whole number is read from a whole number of its range only;
/// others throw nlohmann's type_error. By itself, nlohmann converts any real number, even NaN, which is undefined.

/// @cond
template <class T>
requires(std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>) struct nlohmann::adl_serializer<T> {
    static void to_json(json& j, T value) { nlohmann::to_json(j, value); }
    static void from_json(const json& j, T& value) {
        const bool fits = j.is_number_unsigned()
                              ? std::in_range<T>(j.get_ref<const std::uint64_t&>())
                              : j.is_number_integer() && std::in_range<T>(j.get_ref<const std::int64_t&>());
        if (!fits) throw json::type_error::create(302, "not a whole number of this type's range: " + j.dump(), &j);
        nlohmann::from_json(j, value);
    }
};
/// @endcond

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
