#pragma once

#include <boost/random/normal_distribution.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace ga {

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): a bijection in which every input bit moves every
/// output bit. All random numbers of the engine come from it, so they are the same on every machine.
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// 2^64 over the golden ratio, made odd: splitmix64's step (Steele, Lea and Flood 2014).
constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15u;

/// A key made of a key and one more word; the order of words matters.
constexpr std::uint64_t fold(std::uint64_t key, std::uint64_t word) {
    return mix(key + golden_step + mix(word ^ 0x6a09e667f3bcc909u));
}

/// A key made of a key and a text (FNV-1a over its bytes).
constexpr std::uint64_t fold(std::uint64_t key, std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return fold(key, hash);
}

/// An independent sequence of random numbers for each key: splitmix64 started at the key. A value; making one
/// costs nothing, so every individual of every stage has its own. The distributions are Boost.Random's bit by
/// bit; those that engines draw most are written without its branches on random bits.
class Stream {
  public:
    ///@{
    /// What the standard asks of a generator of random bits: 64 of them a call.
    using result_type = std::uint64_t;
    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

    /// Starts at the key.
    explicit constexpr Stream(std::uint64_t key) : state_(key) {}
    constexpr result_type operator()() { return mix(state_ += golden_step); }
    ///@}

    /// Uniform in [0, 1).
    double uniform() {
        double number;
        do
            number = as_double((*this)()) * 0x1p-64;
        while (number == 1); // rounded up
        return number;
    }
    /// Uniform in [lower, upper).
    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
    /// Normal, mean 0 and deviation 1.
    double normal() { return boost::random::normal_distribution<double>()(*this); }
    /// True with the given probability.
    bool chance(double probability) {
        return probability != 0 && as_double((*this)()) <= probability * 0x1p64;
    }
    /// Uniform over 0 .. n-1; n >= 1.
    std::size_t below(std::size_t n) {
        if (n == 1)
            return 0;
        const std::uint64_t bucket = max() / n + (max() % n == n - 1 ? 1 : 0);
        std::size_t number;
        do
            number = (*this)() / bucket;
        while (number >= n);
        return number;
    }

  private:
    /// The nearest double; as halves, since the processor converts signed numbers alone.
    static double as_double(std::uint64_t word) {
        return static_cast<double>(static_cast<std::int64_t>(word >> 32)) * 0x1p32 +
               static_cast<double>(static_cast<std::int64_t>(word & 0xffffffff));
    }

    std::uint64_t state_;
};

/// A probability with which each of a row of things is picked, by drawing how many are passed over between
/// two: a draw for each pick, not for each thing. Under 1e-15 nothing is picked.
class Chance {
  public:
    /// `probability` in [0, 1]; less counts as 0, more as 1.
    Chance(double probability)
        : probability_(probability), sure_(probability >= 1), never_(!(probability > 1e-15)),
          log_of_rest_(std::log(1 - probability)) {}

    double probability() const { return probability_; } ///< as it was given

    /// Calls pick(i) for the positions that are picked of 0 .. n-1.
    template <class Pick>
    void each(std::size_t n, Stream& stream, Pick pick) const {
        for (std::size_t i = gap(stream); i < n; i += 1 + gap(stream))
            pick(i);
    }

  private:
    std::size_t gap(Stream& stream) const {
        constexpr std::size_t beyond = std::numeric_limits<std::size_t>::max() / 2;
        if (sure_ || never_)
            return sure_ ? 0 : beyond;
        return static_cast<std::size_t>(
            static_cast<std::int64_t>(std::log(1 - stream.uniform()) / log_of_rest_));
    }

    double probability_;
    bool sure_, never_;
    double log_of_rest_;
};

} // namespace ga
