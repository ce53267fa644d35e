#pragma once

#include "ga/base/json.hpp"
#include "ga/pipeline/stage.hpp"

namespace ga {

/// The epsilon-constrained method (Takahama and Sakai 2006), used after `score`. A constraint counts as met
/// if its violation is at most its level, in the population and in the generation's start. The first level
/// has a share `share` of the population within it. In generation t a level decays like
/// (1 - t/generations)^power, and later it is 0. It also falls to the violation that a share `share` of the
/// current population does not exceed. In the source only time lowers the level. The population may then
/// converge beyond the feasible set long before the level matters, and cannot move back.
///
/// Unlike in the source, every constraint has a separate level, so that units do not matter. The levels apply
/// only inside the block and not to the best individual of the run.
struct Epsilon : Operator {
    std::size_t generations = 1; ///< number of generations until the levels are 0
    double share = 0.5;          ///< share of the population within the levels, 0 to 1
    double power = 5;            ///< decay of the levels, > 0

    /// The levels and the generation.
    struct State {
        std::vector<double> levels; ///< levels of the last generation, one per constraint
        std::size_t generation = 0; ///< number of the next generation
    };

    static constexpr const char* needs = "constraints: violation(outcome)";
    static Words words() { return {"epsilon", "adaptation", "constraints hold up to a level that falls to 0"}; }
    static void describe(auto& self, auto visit) {
        visit(self.generations, whole("generations", std::nullopt, 1, "generations until the levels are 0"));
        visit(self.share, number("share", 0, 1, "share of the population within the levels").keyed().quiet());
        visit(self.power, number("power", above_zero, no_limit, "decay of the levels").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Constrained P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context, State& state) const {
        std::vector<double> levels = levels_of(population);
        if (const std::size_t t = state.generation++; t > 0) {
            const double left = generations > t ? static_cast<double>(generations - t) : 0;
            levels.resize(state.levels.size(), 0);
            for (std::size_t k = 0; k < levels.size(); ++k)
                levels[k] = std::min(levels[k], state.levels[k]) * std::pow(left / (left + 1), power);
        }
        for (auto* part : {&population, &context.generation_start()})
            for (auto& individual : *part)
                if (!individual.fitness.violations().empty()) individual.fitness = individual.fitness.relaxed(levels);
        state.levels = std::move(levels);
        return population;
    }

  private:
    template <class G>
    std::vector<double> levels_of(const Population<G>& population) const {
        std::size_t constraints = 0;
        for (const auto& individual : population)
            constraints = std::max(constraints, individual.fitness.violations().size());
        std::vector<double> levels;
        for (std::size_t k = 0; k < constraints; ++k) {
            std::vector<double> each;
            for (const auto& individual : population)
                if (const auto& of = individual.fitness.violations(); !individual.fitness.has_failed())
                    each.push_back(k < of.size() ? of[k] : 0);
            std::sort(each.begin(), each.end());
            const auto within = static_cast<std::size_t>(share * static_cast<double>(each.size()));
            levels.push_back(each[std::min(within, each.size() - 1)]);
        }
        return levels;
    }
};

inline void to_json(nlohmann::json& j, const Epsilon::State& s) { j = {s.levels, s.generation}; }
inline void from_json(const nlohmann::json& j, Epsilon::State& s) { read_parts(j, s.levels, s.generation); }

/// The stage `epsilon generations`.
inline Epsilon epsilon(std::size_t generations) { return checked(Epsilon{{}, generations}); }

} // namespace ga
