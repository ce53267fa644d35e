#pragma once

#include <boost/endian/conversion.hpp>

#include <array>
#include <string>
#include <string_view>

namespace rough {

/// The number at a position in `bytes`, lowest byte first. There must be enough bytes.
template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    const auto* place = reinterpret_cast<const unsigned char*>(bytes.data() + at);
    return boost::endian::endian_load<T, sizeof(T), boost::endian::order::little>(place);
}

/// Appends a number, lowest byte first.
template <class T>
void append_little_endian(std::string& bytes, T value) {
    std::array<unsigned char, sizeof(T)> stored;
    boost::endian::endian_store<T, sizeof(T), boost::endian::order::little>(stored.data(), value);
    bytes.append(stored.begin(), stored.end());
}

} // namespace rough
