#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// Evaluates the individuals without a fitness under the objective. One outcome gives the values of all
/// objectives. A stored outcome is not computed again.
struct Score : Operator {
    std::string objective; ///< name of the objective; empty: the problem's first

    static constexpr bool keeps_size = true; ///< it adds no individual
    static Words words() {
        return {"score", "selection", "evaluates the individuals without a fitness under the objective"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.objective, word("objective", "one of the problem's; by default its first"));
    }
    void check(CheckState& known) const { known.scored = known.objective(text_of(*this), objective); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        context.score(population, objective);
        return population;
    }
};

/// The stage `score objective`; by default the problem's first.
inline Score score(std::string objective = {}) { return {{}, std::move(objective)}; }
/// The stage `score objective`.
template <class Outcome>
Score score(const Objective<Outcome>& objective) {
    return score(objective.name);
}

/// Gives each individual the mean fitness of n replicates of a noisy evaluation, in place of `score`. When it
/// runs again, it adds n replicates to each individual that is still there, until it has `limit`. So an
/// individual does not stay the best only because of lucky draws. Known replicates are not evaluated again.
struct Average : Operator {
    std::size_t n = 2;     ///< number of replicates that the stage adds each time
    std::string objective; ///< name of the objective; empty: the problem's first
    std::size_t limit = 0; ///< maximum number of replicates of one individual; 0 for n

    static constexpr bool keeps_size = true; ///< it adds no individual
    static constexpr const char* needs = "a noisy evaluation (evaluate(genome, replicate))";
    static Words words() { return {"average", "selection", "the mean fitness of n replicates of a noisy evaluation"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", std::nullopt, 1, "replicates that are added each time").up_to(1e6));
        visit(self.objective, word("objective", "one of the problem's; by default its first"));
        visit(self.limit,
              whole("limit", 0, "maximum replicates of one individual in total; 0 for n").up_to(1e6).keyed().quiet());
    }
    void check(CheckState& known) const { known.scored = known.objective(text_of(*this), objective); }

    template <Noisy P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        context.average(population, objective, n, limit);
        return population;
    }
};

/// The stage `average n objective limit=limit`.
inline Average average(std::size_t n, std::string objective = {}, std::size_t limit = 0) {
    return checked(Average{{}, n, std::move(objective), limit});
}

} // namespace ga
