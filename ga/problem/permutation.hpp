#pragma once

#include "ga/base/random.hpp"

#include <numeric>
#include <utility>
#include <vector>

namespace ga {

/// A genome that contains each of 0 .. n-1 once. Only operators that preserve this apply.
struct Permutation {
    std::vector<std::uint32_t> order; ///< each of 0 .. n-1 once

    auto begin() const { return order.begin(); }      ///< the first number
    auto end() const { return order.end(); }          ///< past the last number
    std::size_t size() const { return order.size(); } ///< length n
    /// Whether both permutations are equal.
    bool operator==(const Permutation&) const = default;
    /// Whether `order` contains each of 0 .. n-1 once.
    bool is_valid() const {
        std::vector<char> seen(order.size(), 0);
        return std::all_of(begin(), end(), [&](std::uint32_t number) {
            return number < seen.size() && !std::exchange(seen[number], char{1});
        });
    }

    /// Any order with equal probability.
    static Permutation random(std::size_t n, Stream& stream) {
        Permutation permutation;
        permutation.order.resize(n);
        std::iota(permutation.order.begin(), permutation.order.end(), 0u);
        for (std::size_t i = n; i > 1; --i)
            std::swap(permutation.order[i - 1], permutation.order[stream.below(i)]);
        return permutation;
    }
};

} // namespace ga
