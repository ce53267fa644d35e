#pragma once

#include "domain/text/bytes.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace app {

/// Texts one after another, each behind its length.
inline std::string framed(const std::vector<std::string>& parts) {
    std::string bytes;
    for (const std::string& part : parts) {
        rough::append_little_endian(bytes, static_cast<std::uint64_t>(part.size()));
        bytes += part;
    }
    return bytes;
}

/// Undoes framed(), whose bytes these must be.
inline std::vector<std::string> unframed(std::string_view bytes) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto size = static_cast<std::size_t>(rough::little_endian<std::uint64_t>(bytes, at));
        parts.emplace_back(bytes.substr(at + sizeof(std::uint64_t), size));
        at += sizeof(std::uint64_t) + size;
    }
    return parts;
}

/// A number as bytes, and back.
template <class T>
std::string number_bytes(T value) {
    std::string bytes;
    rough::append_little_endian(bytes, value);
    return bytes;
}
template <class T>
T number_of(std::string_view bytes) {
    return rough::little_endian<T>(bytes, 0);
}

/// JSON as bytes; nlohmann::json::from_cbor undoes it.
inline std::string cbor_of(const nlohmann::json& j) {
    std::string bytes;
    nlohmann::json::to_cbor(j, bytes);
    return bytes;
}

} // namespace app
