#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace rough {

/// The unsigned number of as many bits.
template <class T>
using Word =
    std::conditional_t<sizeof(T) == 1, std::uint8_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                          std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// The number that stands at a place of some bytes, lowest byte first; the bytes must reach that far.
template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    Word<T> word = 0;
    for (std::size_t i = sizeof(T); i-- > 0;)
        word = static_cast<Word<T>>(static_cast<std::uint64_t>(word) << 8 |
                                    static_cast<unsigned char>(bytes[at + i]));
    return std::bit_cast<T>(word);
}

/// Adds a number, lowest byte first.
template <class T>
void append_little_endian(std::string& bytes, T value) {
    auto word = static_cast<std::uint64_t>(std::bit_cast<Word<T>>(value));
    for (std::size_t i = 0; i < sizeof(T); ++i, word >>= 8)
        bytes += static_cast<char>(word & 0xFF);
}

} // namespace rough
