#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Gives each individual the mean fitness of n replicates of a noisy evaluation, in place of `score`. An
/// individual that is met again, as one of the elite is, gets n more until it has `limit`, so that nobody
/// stays the best by lucky draws; the best of the run follows its mean. Replicates that are known are not
/// evaluated again.
struct Average : Operator {
    std::size_t n = 2;     ///< replicates, and how many more each time
    std::string objective; ///< empty: the problem's first
    std::size_t limit = 0; ///< replicates of one individual; 0 for n

    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"average", "selection", "the mean fitness of n replicates of a noisy evaluation"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", std::nullopt, 1, "replicates, and as many more each time").up_to(1e6));
        visit(self.objective, word("objective", "", "one of the problem's; its first where none is given"));
        visit(self.limit,
              whole("limit", "0", 0, "replicates of one individual; 0 for n").up_to(1e6).keyed().quiet());
    }
    void check(CheckState& known) const { known.scored = known.objective(text_of(*this), objective); }

    template <Noisy P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        context.average(population, objective, n, limit);
        return population;
    }
    ///@}
};

/// The stage `average n objective limit=limit`.
inline Average average(std::size_t n, std::string objective = {}, std::size_t limit = 0) {
    return checked(Average{{}, n, std::move(objective), limit});
}

} // namespace ga
