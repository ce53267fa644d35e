#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// A way to cross two genomes in place: words() and describe() as an operator has, and, constrained by what
/// it uses of the problem, `void operator()(const P&, Genome& a, Genome& b, Stream&) const`.
template <class Way, class P>
concept Crosses = Problem<P> &&
    requires(const Way& way, const P& problem, typename P::Genome& genome, Stream& stream) {
    way(problem, genome, genome, stream);
};

/// Crosses neighbours, first with second, third with fourth and so on, each pair with probability `rate`; an
/// odd last one stays. The two children take their parents' places, unscored. `random` before it shuffles who
/// meets whom.
template <class Way>
struct Cross : Operator {
    Way way;         ///< how two genomes are crossed (Crosses)
    double rate = 1; ///< probability of each pair, [0, 1]
    ///@{
    /// What every operator has (Operator).
    static Words words() {
        const Words of_way = Way::words();
        return {"cross " + of_way.name, "cross-over", of_way.meaning};
    }
    static void describe(auto& self, auto visit) {
        Way::describe(self.way, visit);
        visit(self.rate, number("rate", "1", 0, 1, "a pair's chance to be crossed").keyed().quiet());
    }
    void check(CheckState& known) const { known.scored.reset(); }

    template <class P>
    requires Crosses<Way, P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        Stream next = context.stream(0); // made ahead, while the processor waits for the one before
        for (std::size_t i = 0; i + 1 < population.size(); i += 2) {
            Stream stream = std::exchange(next, context.stream(i + 2));
            if (rate < 1 && !stream.chance(rate))
                continue;
            auto &a = population[i], &b = population[i + 1];
            way(context.problem(), a.genome, b.genome, stream);
            const Parents parents(a.identity, b.identity);
            context.make_child(a, parents);
            context.make_child(b, parents);
        }
        return population;
    }
    ///@}
};

/// @param rate  probability that a pair is crossed, 0 to 1
template <class Way>
Cross<Way> cross(Way way, double rate = 1) {
    return checked(Cross<Way>{{}, std::move(way), rate});
}

} // namespace ga
