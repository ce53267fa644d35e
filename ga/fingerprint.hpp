#pragma once

#include "ga/random.hpp"

#include <bit>
#include <concepts>
#include <cstring>
#include <ranges>
#include <string>
#include <string_view>

namespace ga {

/// 128 bits that stand for a genome in the memory of known outcomes: two genomes with equal fingerprints are
/// taken for the same. Among 10^9 distinct genomes any two coincide with probability 1.5e-21.
struct Fingerprint {
    std::uint64_t high = 0, low = 0;
    bool operator==(const Fingerprint&) const = default;
};

/// MurmurHash3_x64_128's rounds (A. Appleby, public domain) over the bytes, little-endian words.
inline Fingerprint fingerprint(const void* data, std::size_t size) {
    constexpr std::uint64_t c1 = 0x87c37b91114253d5u, c2 = 0x4cf5ad432745937fu;
    const char* bytes = static_cast<const char*>(data);
    std::uint64_t h1 = 0, h2 = 0;
    const auto round = [&](std::uint64_t k1, std::uint64_t k2) {
        h1 ^= std::rotl(k1 * c1, 31) * c2;
        h1 = (std::rotl(h1, 27) + h2) * 5 + 0x52dce729u;
        h2 ^= std::rotl(k2 * c2, 33) * c1;
        h2 = (std::rotl(h2, 31) + h1) * 5 + 0x38495ab5u;
    };
    std::uint64_t words[2];
    std::size_t done = 0;
    for (; done + sizeof words <= size; done += sizeof words) {
        std::memcpy(words, bytes + done, sizeof words);
        round(words[0], words[1]);
    }
    if (done < size) {
        words[0] = words[1] = 0;
        std::memcpy(words, bytes + done, size - done);
        round(words[0], words[1]);
    }
    h1 = mix(h1 ^ size), h2 = mix(h2 ^ size);
    return {mix(h1 + h2), mix(h1 + std::rotl(h2, 32) + golden_step)};
}

template <class T>
concept PlainNumber = std::integral<T> || std::same_as<T, float> || std::same_as<T, double>;

/// A genome whose bits ga can read by itself: a range of numbers. Others give their problem a member `key`.
template <class G>
concept RangeOfNumbers =
    std::ranges::input_range<const G> && PlainNumber<std::ranges::range_value_t<const G>>;

inline Fingerprint fingerprint(std::string_view bytes) { return fingerprint(bytes.data(), bytes.size()); }

template <RangeOfNumbers G>
requires(!std::convertible_to<G, std::string_view>) Fingerprint fingerprint(const G& genome) {
    using T = std::ranges::range_value_t<const G>;
    if constexpr (std::ranges::contiguous_range<const G>) {
        return fingerprint(std::ranges::data(genome), sizeof(T) * std::ranges::size(genome));
    } else {
        std::string bytes;
        for (const T value : genome)
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        return fingerprint(std::string_view(bytes));
    }
}

} // namespace ga
