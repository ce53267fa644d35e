#pragma once

#include "ga/variation/cross.hpp"
#include "ga/variation/genes.hpp"

namespace ga {

/// Exchanges the genes of each position with probability 1/2 (Syswerda 1989), up to the shorter genome's
/// length.
struct Uniform {
    ///@{
    /// What every way of crossing has (Crosses).
    static Words words() { return {"uniform", "cross-over", "exchanges each position with probability 1/2"}; }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires(CrossesUniformly<P> || Positional<typename P::Genome>) void
    operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        if constexpr (CrossesUniformly<P>) {
            problem.cross_uniform(a, b, stream);
        } else {
            const std::size_t length = std::min<std::size_t>(a.size(), b.size());
            std::uint64_t coins = 0;
            for (std::size_t i = 0; i < length; ++i, coins >>= 1) {
                if (i % 64 == 0)
                    coins = stream();
                if (coins & 1) {
                    auto kept = a[i]; // vector<bool>'s elements cannot be swapped as references
                    a[i] = b[i];
                    b[i] = kept;
                }
            }
        }
    }
    ///@}
};

/// `uniform` of cross.
inline Uniform uniform() { return {}; }

} // namespace ga
