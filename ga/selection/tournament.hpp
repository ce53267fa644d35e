#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Fills each place with the best of k individuals that are drawn with replacement (Brindle 1981). The one
/// drawn first wins a tie. The best of n gets k of n places on average.
struct Tournament : Operator {
    std::size_t k = 2;    ///< individuals drawn for each place, >= 1
    std::size_t size = 0; ///< number of places; 0 for the population's size
    ///@{ What every operator has (Operator).
    static Words words() {
        return {"tournament", "selection", "each place goes to the best of k drawn at random"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.k, whole("k", "2", 1, "how many are drawn"));
        visit(self.size, whole("size", "0", 0, "places; 0 for as many as there are").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        if (population.empty())
            return population;
        context.need_room(size, population);
        const std::vector<double> worth = merits(population);
        const Below any(population.size());
        std::vector<std::size_t> winners(size > 0 ? size : population.size());
        Stream next = context.stream(0); // computed ahead, while the processor waits for the previous one
        for (std::size_t i = 0; i < winners.size(); ++i) {
            Stream stream = std::exchange(next, context.stream(i + 1));
            std::size_t winner = any(stream);
            for (std::size_t draw = 1; draw < k; ++draw)
                if (const std::size_t rival = any(stream); worth[rival] > worth[winner])
                    winner = rival;
            winners[i] = winner;
        }
        return context.gather(std::move(population), winners);
    }
    ///@}
};

/// The stage `tournament k size=size`.
inline Tournament tournament(std::size_t k, std::size_t size = 0) { return checked(Tournament{{}, k, size}); }

} // namespace ga
