#pragma once

#include "ga/stopping/rule.hpp"

#include <tuple>

namespace ga {

/// Ends after n generations.
struct AfterGenerations : StoppingRule {
    std::size_t n = 1; ///< >= 1

    ///@{ What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() { return {"generations", "stopping", "this number of generations is completed"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("generations", "", 1, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.generation >= n;
    }
    ///@}
};

/// Ends after n requested evaluations since the block began, including those answered from memory.
struct AfterEvaluations : StoppingRule {
    long n = 1; ///< >= 1

    ///@{ What every rule has (StoppingRule).
    static Words words() { return {"evaluations", "stopping", "this number of evaluations was requested"}; }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("evaluations", "", 1, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.asked >= n;
    }
    ///@}
};

/// Ends after a time since the block began. Such a run cannot be repeated bit for bit.
struct AfterSeconds : StoppingRule {
    double limit = 0; ///< s

    ///@{ What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() {
        return {"seconds", "stopping", "this time has passed; such a run cannot be repeated bit for bit"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.limit, number("seconds", "", 0, no_limit, words().meaning));
    }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return now.seconds >= limit;
    }
    ///@}
};

/// Ends when a feasible individual reaches a fitness, in the direction of its objective.
struct AtFitness : StoppingRule {
    double value = 0; ///< in the objective's units

    ///@{ What every rule has (StoppingRule).
    static Words words() { return {"fitness", "stopping", "the best fitness reaches this value"}; }
    static void describe(auto& self, auto visit) {
        visit(self.value, number("fitness", "", -no_limit, no_limit, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_one_objective(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        return std::any_of(now.population.begin(), now.population.end(), [&](const auto& individual) {
            const Fitness& f = individual.fitness;
            return f.known() && !f.has_failed() && f.feasible() &&
                   (f.minimises() ? f.value() <= value : f.value() >= value);
        });
    }
    ///@}
};

/// Ends after n generations without an improvement (`improves`).
struct AtStagnation : StoppingRule {
    std::size_t n = 1; ///< >= 1

    ///@{ What every rule has (StoppingRule).
    static constexpr bool sure = true;
    static Words words() {
        return {"stagnation", "stopping", "this number of generations brought no improvement"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("stagnation", "", 1, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers& memory) const {
        improves(now, memory);
        return static_cast<double>(now.generation) - memory[2] >= static_cast<double>(n);
    }
    ///@}
};

/// Ends when the population has converged: all individuals are feasible, and the values of every objective
/// differ by at most `most`. This is the tolerance on f of libpagmo's and NLopt's searches.
struct AtConvergence : StoppingRule {
    double most = 0; ///< in the objective's units, >= 0

    ///@{ What every rule has (StoppingRule).
    static Words words() { return {"converged", "stopping", "best and worst differ by at most this"}; }
    static void describe(auto& self, auto visit) {
        visit(self.most, number("converged", "", 0, no_limit, words().meaning));
    }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        Point least, greatest;
        for (const auto& individual : now.population) {
            const Fitness& fitness = individual.fitness;
            if (!fitness.known() || fitness.has_failed() || !fitness.feasible())
                return false;
            const Point values = fitness.several() ? fitness.values() : Point{fitness.merit()};
            if (least.empty())
                least = greatest = values;
            for (std::size_t k = 0; k < values.size(); ++k) {
                least[k] = std::min(least[k], values[k]);
                greatest[k] = std::max(greatest[k], values[k]);
                if (greatest[k] - least[k] > most)
                    return false;
            }
        }
        return true;
    }
    ///@}
};

/// The end of a block of generations: the first of these rules that holds, checked before every generation.
/// Give at least one: `until({.evaluations = 10000, .fitness = 0.99}, body)`. Only a run that ends because of
/// `seconds` cannot be repeated bit for bit.
struct Until {
    std::optional<std::size_t> generations = std::nullopt; ///< completed generations
    std::optional<long> evaluations = std::nullopt;        ///< requested evaluations since the block began
    std::optional<double> seconds = std::nullopt;          ///< time since the block began
    std::optional<double> fitness = std::nullopt;          ///< fitness that the best reaches
    std::optional<std::size_t> stagnation = std::nullopt;  ///< generations since the last improvement
    std::optional<double> converged = std::nullopt;        ///< difference of best and worst

    /// The rules that were given.
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
/// Combines rules.
template <class... R>
AnyOf<R...> any_of(R... rules) {
    return {{std::move(rules)...}};
}

/// Rules that a text names.
template <class Genome>
struct RuleList {
    std::vector<Rule<Genome>> list; ///< the rules

    /// For that type of genome.
    template <class G>
    requires std::same_as<G, Genome>
    const std::vector<Rule<G>>& rules() const { return list; }
};

} // namespace ga
