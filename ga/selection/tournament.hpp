#pragma once

#include "ga/stage.hpp"

namespace ga {

/// Each place goes to the best of k individuals drawn with replacement (Brindle 1981); the one drawn first
/// wins a tie. The best of n is expected k times in n places.
struct Tournament : Operator {
    std::size_t k;    ///< drawn for each place, >= 1
    std::size_t size; ///< places; 0 for as many as there are individuals

    /// Throws UsageError where none are drawn.
    Tournament(std::size_t drawn, std::size_t places) : k(drawn), size(places) {
        if (k == 0)
            throw UsageError("tournament 0 draws nobody; expected at least 1");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const {
        return "tournament " + std::to_string(k) + (size > 0 ? " size=" + std::to_string(size) : "");
    }
    void check(Known& known) const { known.need_score(text()); }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population,
                                              Context<P>& context) const {
        std::vector<std::size_t> winners(size > 0 ? size : population.size());
        for (std::size_t i = 0; i < winners.size(); ++i) {
            Stream stream = context.stream(i);
            std::size_t winner = stream.below(population.size());
            for (std::size_t draw = 1; draw < k; ++draw)
                if (const std::size_t rival = stream.below(population.size());
                    population[rival].value() > population[winner].value())
                    winner = rival;
            winners[i] = winner;
        }
        return context.gather(std::move(population), winners);
    }
    ///@}
};

/// The stage `tournament k size=size`.
inline Tournament tournament(std::size_t k, std::size_t size = 0) { return {k, size}; }

} // namespace ga
