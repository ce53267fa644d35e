#pragma once

#include <boost/random/bernoulli_distribution.hpp>
#include <boost/random/geometric_distribution.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>

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
/// costs nothing, so every individual of every stage has its own. The distributions are Boost.Random's.
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
    double uniform() { return boost::random::uniform_01<double>()(*this); }
    /// Uniform in [lower, upper).
    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
    /// Normal, mean 0 and deviation 1.
    double normal() { return boost::random::normal_distribution<double>()(*this); }
    /// True with the given probability.
    bool chance(double probability) {
        return boost::random::bernoulli_distribution<double>(probability)(*this);
    }
    /// Uniform over 0 .. n-1; n >= 1.
    std::size_t below(std::size_t n) {
        return boost::random::uniform_int_distribution<std::size_t>(0, n - 1)(*this);
    }

  private:
    std::uint64_t state_;
};

/// A probability with which each of a row of things is picked, by drawing how many are passed over between
/// two: a draw for each pick, not for each thing. Under 1e-15 nothing is picked.
class Chance {
  public:
    /// `probability` in [0, 1]; less counts as 0, more as 1.
    Chance(double probability)
        : probability_(probability), sure_(probability >= 1), never_(!(probability > 1e-15)),
          gaps_(sure_ || never_ ? 0.5 : probability) {}

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
        return sure_ ? 0 : never_ ? beyond : static_cast<std::size_t>(gaps_(stream));
    }

    double probability_;
    bool sure_, never_;
    boost::random::geometric_distribution<std::int64_t> gaps_;
};

} // namespace ga
