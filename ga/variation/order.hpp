#pragma once

#include "ga/problem/permutation.hpp"
#include "ga/variation/cross.hpp"

namespace ga {

/// Order cross-over (Davis 1985): each child keeps a piece of one parent in place and takes the rest in the
/// order of the other, from the end of the piece on. Permutations of unequal length stay as they are.
struct Order {
    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() {
        return {"order", "cross-over",
                "keeps a piece of one permutation in place and the other's order elsewhere"};
    }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires std::same_as<typename P::Genome, Permutation>
    void operator()(const P&, Permutation& a, Permutation& b, Stream& stream) const {
        const std::size_t n = a.size();
        if (n != b.size() || n < 2)
            return;
        std::size_t from = stream.below(n), to = stream.below(n);
        if (from > to)
            std::swap(from, to);
        const Permutation first = child(a, b, from, to + 1);
        b = child(b, a, from, to + 1);
        a = first;
    }
    ///@}

  private:
    static Permutation child(const Permutation& keeper, const Permutation& other, std::size_t from,
                             std::size_t to) {
        const std::size_t n = keeper.size();
        Permutation child = keeper;
        std::vector<bool> taken(n);
        for (std::size_t i = from; i < to; ++i)
            taken[keeper.order[i]] = true;
        std::size_t place = to % n;
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t next = other.order[(to + i) % n];
            if (taken[next])
                continue;
            child.order[place] = next;
            place = (place + 1) % n;
        }
        return child;
    }
};

/// `order` of cross.
inline Order order() { return {}; }

} // namespace ga
