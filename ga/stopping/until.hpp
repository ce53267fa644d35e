#pragma once

#include "ga/stopping/convergence.hpp"
#include "ga/stopping/evaluations.hpp"
#include "ga/stopping/fitness.hpp"
#include "ga/stopping/generations.hpp"
#include "ga/stopping/seconds.hpp"
#include "ga/stopping/stagnation.hpp"

#include <tuple>

namespace ga {

/// When a block of generations ends: at the first of the engine's own rules that holds, looked at before
/// every generation. At least one is given: `until({.evaluations = 10000, .fitness = 0.99}, body)`. A run
/// that ends on seconds cannot be repeated bit for bit; every other can.
struct Until {
    std::optional<std::size_t> generations = std::nullopt; ///< this many were made
    std::optional<long> evaluations = std::nullopt;        ///< this many were asked for since the block began
    std::optional<double> seconds = std::nullopt;          ///< this long since the block began
    std::optional<double> fitness = std::nullopt;          ///< the best of the population reaches this
    std::optional<std::size_t> stagnation =
        std::nullopt;                               ///< this many generations since the best last improved
    std::optional<double> converged = std::nullopt; ///< best and worst no further apart

    /// Those that were given.
    template <class G>
    std::vector<Rule<G>> rules() const {
        std::vector<Rule<G>> all;
        const auto add = [&](const auto& value, auto rule) {
            if (value)
                all.push_back(rule_of<G>(rule));
        };
        add(generations, AfterGenerations{{}, generations.value_or(1)});
        add(evaluations, AfterEvaluations{{}, evaluations.value_or(1)});
        add(seconds, AfterSeconds{{}, seconds.value_or(0)});
        add(fitness, AtFitness{{}, fitness.value_or(0)});
        add(stagnation, AtStagnation{{}, stagnation.value_or(1)});
        add(converged, AtConvergence{{}, converged.value_or(0)});
        return all;
    }
};

/// Ends at the first of these rules: `until(any_of(AtStagnation{{}, 5}, MyRule()), body)`.
template <class... R>
struct AnyOf {
    std::tuple<R...> of; ///< the rules

    /// For one type of genome.
    template <class G>
    std::vector<Rule<G>> rules() const {
        return std::apply([](const R&... each) { return std::vector<Rule<G>>{rule_of<G>(each)...}; }, of);
    }
};
/// Of these rules.
template <class... R>
AnyOf<R...> any_of(R... rules) {
    return {{std::move(rules)...}};
}

/// Rules found when a text was read.
template <class Genome>
struct RuleList {
    std::vector<Rule<Genome>> list; ///< the rules

    /// For that type of genome.
    template <class G>
    requires std::same_as<G, Genome>
    const std::vector<Rule<G>>& rules() const { return list; }
};

} // namespace ga
