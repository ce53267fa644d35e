#pragma once

#include "ga/base/random.hpp"

#include <compare>
#include <concepts>
#include <cstring>
#include <ranges>
#include <string>

namespace ga {

/// 128 bits that identify a genome in the memory of known outcomes: genomes with equal fingerprints count as
/// equal. Among 10^9 distinct genomes any two coincide with probability 1.5e-21.
struct Fingerprint {
    std::uint64_t high = 0; ///< first lane
    std::uint64_t low = 0;  ///< second lane
    /// Compares the lanes in order.
    auto operator<=>(const Fingerprint&) const = default;
};

/// The fingerprint of some bytes: two independent lanes of folded 64 x 64 -> 128 bit products (the scheme of
/// wyhash, Wang Yi 2019).
inline Fingerprint fingerprint(const void* data, std::size_t size) {
    __extension__ using Wide = unsigned __int128;
    const auto folded = [](std::uint64_t a, std::uint64_t b) {
        const Wide product = static_cast<Wide>(a) * b;
        return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
    };
    const char* bytes = static_cast<const char*>(data);
    std::uint64_t high = 0x2d358dccaa6c78a5u ^ size, low = 0x8bb84b93962eacc9u ^ size, words[2];
    const auto take = [&] {
        high = folded(words[0] ^ 0x4b33a62ed433d4a3u, words[1] ^ high);
        low = folded(words[1] ^ 0x4d5a2da51de1aa47u, words[0] ^ low);
    };
    std::size_t done = 0;
    for (; done + sizeof words <= size; done += sizeof words) {
        std::memcpy(words, bytes + done, sizeof words);
        take();
    }
    if (done < size) {
        words[0] = words[1] = 0;
        std::memcpy(words, bytes + done, size - done);
        take();
    }
    return {mix(high + golden_step), mix(low)};
}

template <class T>
concept PlainNumber = std::integral<T> || std::same_as<T, float> || std::same_as<T, double>;

/// A genome with bits that ga can read: a range of numbers. For other genomes the problem has a member `key`.
template <class G>
concept RangeOfNumbers = std::ranges::input_range<const G> && PlainNumber<std::ranges::range_value_t<const G>>;

/// The fingerprint of bytes, including their number.
inline Fingerprint fingerprint(std::string_view bytes) { return fingerprint(bytes.data(), bytes.size()); }

/// The fingerprint of a genome that is a range of numbers, by their bytes.
template <RangeOfNumbers G>
requires(!std::convertible_to<G, std::string_view>) Fingerprint fingerprint(const G& genome) {
    using T = std::ranges::range_value_t<const G>;
    if constexpr (std::ranges::contiguous_range<const G>) {
        return fingerprint(std::ranges::data(genome), sizeof(T) * std::ranges::size(genome));
    } else {
        std::string bytes;
        for (const T value : genome) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        return fingerprint(std::string_view(bytes));
    }
}

} // namespace ga
