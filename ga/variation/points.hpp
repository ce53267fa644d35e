#pragma once

#include "ga/variation/cross.hpp"
#include "ga/variation/genes.hpp"

#include <algorithm>
#include <numeric>

namespace ga {

/// Cuts two sequences at the same n different places and exchanges every other piece. Sequences of unequal
/// length exchange within the shorter one's; those too short for n cuts take as many as fit.
template <class Sequence>
void exchange_at_points(Sequence& a, Sequence& b, std::size_t n, Stream& stream) {
    const std::size_t length = std::min<std::size_t>(a.size(), b.size());
    if (length < 2)
        return;
    const auto exchange = [&](std::size_t from, std::size_t to) {
        const auto at = [](auto& sequence, std::size_t i) {
            return sequence.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::swap_ranges(at(a, from), at(a, to), at(b, from));
    };
    if (n == 1)
        return exchange(1 + stream.below(length - 1), length);
    std::vector<std::size_t> cuts(length - 1);
    std::iota(cuts.begin(), cuts.end(), std::size_t{1});
    const std::size_t count = std::min(n, cuts.size());
    for (std::size_t i = 0; i < count; ++i)
        std::swap(cuts[i], cuts[i + stream.below(cuts.size() - i)]);
    cuts.resize(count);
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(length);
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
        exchange(cuts[i], cuts[i + 1]);
}

/// n-point cross-over of genomes (Holland 1975; De Jong 1975): exchange_at_points between their genes, or the
/// problem's own.
struct Points {
    std::size_t n = 2; ///< cuts, >= 1

    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() { return {"n_points", "cross-over", "exchanges every other piece between n cuts"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", "2", 1, "cuts")); }

    template <Problem P>
    requires(CrossesAtPoints<P> || Positional<typename P::Genome>) void
    operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        if constexpr (CrossesAtPoints<P>)
            problem.cross_points(a, b, n, stream);
        else
            exchange_at_points(a, b, n, stream);
    }
    ///@}
};

/// The same with one cut.
struct OnePoint {
    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() { return {"one_point", "cross-over", "exchanges what lies beyond one cut"}; }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires Crosses<Points, P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        Points{1}(problem, a, b, stream);
    }
    ///@}
};

/// `one_point` of cross.
inline OnePoint one_point() { return {}; }
/// `n_points n` of cross, n >= 1.
inline Points n_points(std::size_t n) { return {n}; }

} // namespace ga
