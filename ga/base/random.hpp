#pragma once

#include <boost/random/normal_distribution.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace ga {

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): a bijection in which every input bit affects
/// every output bit. All random numbers of the engine come from it, so they are equal on every machine.
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// The step of splitmix64 (Steele, Lea and Flood 2014): 2^64 over the golden ratio, made odd.
constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15u;

/// Combines a key with one more word; the order of words matters.
constexpr std::uint64_t fold(std::uint64_t key, std::uint64_t word) {
    return mix(key + golden_step + mix(word ^ 0x6a09e667f3bcc909u));
}

/// Combines a key with a text (FNV-1a over its bytes).
constexpr std::uint64_t fold(std::uint64_t key, std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return fold(key, hash);
}

/// An independent sequence of random numbers for each key: splitmix64 started at the key. Streams are so
/// cheap that every individual of every stage has one. The distributions give the same bits as those of
/// Boost.Random, but the most frequent ones avoid branches on random bits.
class Stream {
  public:
    ///@{ Members that the C++ standard requires of a generator of random bits, 64 per call.
    using result_type = std::uint64_t;
    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

    /// Starts the sequence of a key.
    explicit constexpr Stream(std::uint64_t key) : state_(key) {}
    constexpr result_type operator()() { return mix(state_ += golden_step); }
    ///@}

    /// A random number, uniform in [0, 1).
    double uniform() {
        double number;
        do number = as_double((*this)()) * 0x1p-64;
        while (number == 1); // rounded up
        return number;
    }
    /// A random number, uniform in [lower, upper).
    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
    /// A random number, normal with mean 0 and standard deviation 1.
    double normal() { return boost::random::normal_distribution<double>()(*this); }
    /// True with the given probability.
    bool chance(double probability) { return probability != 0 && as_double((*this)()) <= probability * 0x1p64; }
    /// A random whole number, uniform over 0 .. n-1; n >= 1.
    std::size_t below(std::size_t n);

  private:
    /// The nearest double. It converts halves, because the processor converts only signed numbers.
    static double as_double(std::uint64_t word) {
        return static_cast<double>(static_cast<std::int64_t>(word >> 32)) * 0x1p32 +
               static_cast<double>(static_cast<std::int64_t>(word & 0xffffffff));
    }

    std::uint64_t state_;
};

/// Draws whole numbers that are uniform over 0 .. n-1; n >= 1. Faster than Stream::below for many draws.
class Below {
  public:
    /// Prepares draws from n numbers.
    explicit Below(std::size_t n)
        : n_(n), words_each_(n == 1 ? 0 : Stream::max() / n + (Stream::max() % n == n - 1 ? 1 : 0)) {}

    /// The next number; for n = 1 nothing is drawn.
    std::size_t operator()(Stream& stream) const {
        __extension__ using Wide = unsigned __int128;
        if (n_ == 1) return 0;
        for (;;) {
            const std::uint64_t word = stream();
            // word / words_each_; for small n by a product that is at most one too small
            auto number =
                static_cast<std::size_t>(n_ >> 32 ? word / words_each_ : (static_cast<Wide>(word) * n_) >> 64);
            number += word - number * words_each_ >= words_each_ ? 1 : 0;
            if (number < n_) return number;
        }
    }

  private:
    std::size_t n_;
    std::uint64_t words_each_; ///< 64-bit words for each number
};

inline std::size_t Stream::below(std::size_t n) { return Below(n)(*this); }

/// Picks each element of a sequence with a given probability. It draws the gaps between picks, so it needs
/// one draw per pick, not per element. Below 1e-15 nothing is picked.
class Chance {
  public:
    /// `probability` in [0, 1]; a value outside is clamped.
    Chance(double probability)
        : probability_(probability), sure_(probability >= 1), never_(!(probability > 1e-15)),
          log_of_rest_(std::log(1 - probability)) {
        if (sure_ || never_) return;
        double passed = 1;
        for (std::uint64_t& limit : limits_)
            limit = static_cast<std::uint64_t>((passed *= 1 - probability) * 0x1p63) << 1;
        std::size_t longest = limits_.size();
        for (std::size_t i = 0; i < longest_.size(); ++i) {
            while (longest > 0 && limits_[longest - 1] <= i << first_bits) --longest;
            longest_[i] = static_cast<std::uint8_t>(longest);
        }
    }

    double probability() const { return probability_; } ///< probability that was given

    /// Calls pick(i) for the picked positions of 0 .. n-1.
    template <class Pick>
    void each(std::size_t n, Stream& stream, Pick pick) const {
        for (std::size_t i = gap(n, stream); i < n; i += 1 + gap(n - i - 1, stream)) pick(i);
    }

  private:
    static constexpr int first_bits = 59; ///< the five first bits of a word begin there

    /// The length of the next gap, at most `left`; it is at least g with probability (1 - p)^g. Short gaps
    /// come from a table, long ones are computed.
    std::size_t gap(std::size_t left, Stream& stream) const {
        if (sure_ || never_) return sure_ ? 0 : left;
        const std::uint64_t word = ~stream();
        if (left == 0 || (left <= limits_.size() && word < limits_[left - 1])) return left;
        if (word < limits_.back()) {
            const double gap = std::log((static_cast<double>(word >> 1) + 1) * 0x1p-63) / log_of_rest_;
            return static_cast<std::size_t>(std::min(gap, static_cast<double>(left)));
        }
        std::size_t gap = longest_[word >> first_bits];
        gap -= gap > 0 && limits_[gap - 1] <= word ? 1 : 0; // nearly always sufficient, without a branch
        while (gap > 0 && limits_[gap - 1] <= word) --gap;
        return gap;
    }

    double probability_;
    bool sure_, never_;
    double log_of_rest_;
    std::array<std::uint64_t, 32> limits_{}; ///< [g - 1]: words below it have a gap of at least g
    std::array<std::uint8_t, 32> longest_{}; ///< longest gap of the words with these first bits
};

} // namespace ga
