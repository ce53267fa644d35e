#pragma once

#include "ga/base/random.hpp"

#include <numeric>
#include <vector>

namespace ga {

/// A genome that is an order of 0 .. n-1, each once. Only operators that keep it one apply.
struct Permutation {
    std::vector<std::uint32_t> order; ///< of 0 .. n-1

    auto begin() const { return order.begin(); }      ///< reads as a range of the order
    auto end() const { return order.end(); }          ///< behind its last
    std::size_t size() const { return order.size(); } ///< n
    /// The same order.
    bool operator==(const Permutation&) const = default;

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
