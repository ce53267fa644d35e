#pragma once

#include "ga/pareto/pareto.hpp"

#include <tuple>

namespace ga {

/// The state of a block before each generation, for its stopping rules.
template <class G>
struct BlockProgress {
    std::size_t generation;          ///< number of completed generations
    double price;                    ///< price of evaluations requested since the block began
    double seconds;                  ///< time since the block began, in all processes of the run, s
    const Population<G>& population; ///< population before the generation
};

/// Numbers that a rule stores from one generation to the next; checkpoints contain them.
using Numbers = std::vector<double>;

/// A stopping rule is a small struct that derives from this base. It has words() and describe() like an
/// operator, and this member:
///
/// @code
///     template <class G> bool operator()(const BlockProgress<G>&, Numbers& memory) const;
/// @endcode
struct StoppingRule {
    static constexpr bool sure = false; ///< whether the rule certainly holds at some time
    /// Throws UsageError if the rule cannot work in the stage of this name.
    void check(const CheckState&, const std::string&) const {}
};

/// A stopping rule for one type of genome.
template <class G>
struct Rule {
    std::string text;                                                 ///< text, e.g. "stagnation 5"
    std::function<void(const CheckState&, const std::string&)> check; ///< see StoppingRule
    std::function<bool(const BlockProgress<G>&, Numbers&)> holds;     ///< whether to end the block
    bool sure;                                                        ///< see StoppingRule
};

/// The rule for one type of genome.
template <class G, class R>
requires std::derived_from<R, StoppingRule> Rule<G> rule_of(R rule) {
    return {text_of(rule), [rule](const CheckState& known, const std::string& stage) { rule.check(known, stage); },
            rule, R::sure};
}

/// Whether the population is better than in all earlier generations of the block. Under one objective the best
/// individuals are compared by Deb's rules. Under several objectives the hypervolumes of the fronts are compared. Their
/// reference is the front's minimum minus a tenth of its range. A front that extends below the reference is an
/// improvement, and moves it. For four objectives or more the hypervolume is estimated (dominated_share). Stores in
/// `memory` the lowest violation, the highest value and the last generation that improved.
template <class G>
bool improves(const BlockProgress<G>& now, Numbers& memory) {
    if (memory.empty()) memory = {HUGE_VAL, -HUGE_VAL, 0};
    double violation = HUGE_VAL, worth = -HUGE_VAL;
    std::vector<Point> points;
    for (const auto& individual : now.population) {
        const Fitness& fitness = individual.fitness;
        if (!fitness.known()) return false;
        const double excess = fitness.violation();
        const double merit = fitness.several() || excess > 0 ? -HUGE_VAL : fitness.merit();
        if (std::pair(excess, -merit) < std::pair(violation, -worth)) violation = excess, worth = merit;
        if (fitness.several() && excess == 0) points.push_back(fitness.values());
    }
    if (!points.empty()) {
        const std::size_t m = points.front().size();
        const std::vector<std::size_t> ranks = pareto_ranks(points);
        Point lowest(m, HUGE_VAL), highest(m, -HUGE_VAL);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t k = 0; ranks[i] == 0 && k < m; ++k) {
                lowest[k] = std::min(lowest[k], points[i][k]);
                highest[k] = std::max(highest[k], points[i][k]);
            }
        const bool first = memory.size() < 3 + 2 * m;
        memory.resize(3 + 2 * m, HUGE_VAL);
        const std::span reference(memory.begin() + 3, m), width(memory.begin() + 3 + std::ptrdiff_t(m), m);
        if (first || !std::ranges::equal(lowest, reference, std::greater_equal())) {
            for (std::size_t k = 0; k < m; ++k) {
                width[k] = std::max({highest[k] - lowest[k], 1e-9, first ? 0 : width[k]});
                reference[k] = std::min(reference[k], lowest[k] - 0.1 * width[k]);
            }
            memory[1] = -HUGE_VAL; // volumes of another reference cannot be compared
        }
        const Point from(reference.begin(), reference.end()), widths(width.begin(), width.end());
        worth = m < 4 ? hypervolume(std::move(points), from) : dominated_share(points, from, widths);
    }
    if (!(std::pair(violation, -worth) < std::pair(memory[0], -memory[1]))) return false;
    memory[0] = violation;
    memory[1] = worth;
    memory[2] = static_cast<double>(now.generation);
    return true;
}

/// The parameter of a rule that takes a whole number, 1 or more. It has the rule's name and meaning.
inline Parameter count_of(const Words& rule) { return whole(rule.name, "", 1, rule.meaning); }
/// The parameter of a rule that takes a real number, `lower` or more. It has the rule's name and meaning.
inline Parameter value_of(const Words& rule, double lower) {
    return number(rule.name, "", lower, no_limit, rule.meaning);
}

/// Ends after n generations.
struct AfterGenerations : StoppingRule {
    std::size_t n = 1; ///< number of generations, >= 1

    static constexpr bool sure = true;
    static Words words() { return {"generations", "stopping", "this number of generations is completed"}; }
    static void describe(auto& self, auto visit) { visit(self.n, count_of(words())); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        return now.generation >= n;
    }
};

/// Ends when the price of evaluations requested since the block began reaches n evaluations of level 0. If
/// the problem has one level, it ends after n evaluations. Those answered from memory count.
struct AfterEvaluations : StoppingRule {
    long n = 1; ///< number of evaluations, >= 1

    static Words words() { return {"evaluations", "stopping", "this number of evaluations was requested"}; }
    static void describe(auto& self, auto visit) { visit(self.n, count_of(words())); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        return now.price >= static_cast<double>(n);
    }
};

/// Ends after a time since the block began. Such a run cannot be repeated bit for bit.
struct AfterSeconds : StoppingRule {
    double limit = 0; ///< time, s

    static constexpr bool sure = true;
    static Words words() {
        return {"seconds", "stopping", "this time has passed; such a run cannot be repeated bit for bit"};
    }
    static void describe(auto& self, auto visit) { visit(self.limit, value_of(words(), 0)); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        return now.seconds >= limit;
    }
};

/// Ends when a feasible individual reaches a fitness, in the direction of its objective. Levels of `epsilon` do
/// not make an individual feasible here.
struct AtFitness : StoppingRule {
    double value = 0; ///< fitness, in the objective's units

    static Words words() { return {"fitness", "stopping", "the best fitness reaches this value"}; }
    static void describe(auto& self, auto visit) { visit(self.value, value_of(words(), -no_limit)); }
    void check(const CheckState& known, const std::string& stage) const { known.need_one_objective(stage); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        return std::ranges::any_of(now.population, [&](const auto& individual) {
            const Fitness& f = individual.fitness;
            return f.known() && f.feasible() && f.violations().empty() &&
                   (f.minimises() ? f.value() <= value : f.value() >= value);
        });
    }
};

/// Ends after n generations without an improvement (`improves`).
struct AtStagnation : StoppingRule {
    std::size_t n = 1; ///< >= 1

    static constexpr bool sure = true;
    static Words words() { return {"stagnation", "stopping", "this number of generations brought no improvement"}; }
    static void describe(auto& self, auto visit) { visit(self.n, count_of(words())); }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers& memory) const {
        improves(now, memory);
        return static_cast<double>(now.generation) - memory[2] >= static_cast<double>(n);
    }
};

/// Ends when the population has converged: all individuals are feasible, and the values of every objective
/// differ by at most `max_difference`. The searches of libpagmo and NLopt call this a tolerance on f.
struct AtConvergence : StoppingRule {
    double max_difference = 0; ///< largest difference, in the objective's units, >= 0

    static Words words() { return {"converged", "stopping", "best and worst differ by at most this"}; }
    static void describe(auto& self, auto visit) { visit(self.max_difference, value_of(words(), 0)); }
    void check(const CheckState& known, const std::string& stage) const { known.need_score(stage); }

    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        Point lowest, highest;
        for (const auto& individual : now.population) {
            const Fitness& fitness = individual.fitness;
            if (!fitness.known() || !fitness.feasible() || !fitness.violations().empty()) return false;
            const Point values = fitness.several() ? fitness.values() : Point{fitness.merit()};
            if (lowest.empty()) lowest = highest = values;
            for (std::size_t k = 0; k < values.size(); ++k) {
                lowest[k] = std::min(lowest[k], values[k]);
                highest[k] = std::max(highest[k], values[k]);
                if (highest[k] - lowest[k] > max_difference) return false;
            }
        }
        return true;
    }
};

/// The end of a block of generations: the first of these rules that holds, checked before every generation.
/// Give at least one: `until({.evaluations = 10000, .fitness = 0.99}, body)`. Only a run that ends because of
/// `seconds` cannot be repeated bit for bit.
struct Until {
    std::optional<std::size_t> generations = std::nullopt; ///< number of completed generations
    std::optional<long> evaluations = std::nullopt;        ///< number of requested evaluations since the block began
    std::optional<double> seconds = std::nullopt;          ///< time since the block began, s
    std::optional<double> fitness = std::nullopt;          ///< fitness that the best individual reaches
    std::optional<std::size_t> stagnation = std::nullopt;  ///< number of generations without an improvement
    std::optional<double> converged = std::nullopt;        ///< largest difference of best and worst

    /// The rules that were given.
    template <class G>
    std::vector<Rule<G>> rules() const {
        std::vector<Rule<G>> all;
        const auto add = [&](const auto& value, auto rule) {
            if (value) all.push_back(rule_of<G>(rule));
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

    /// The rules for one type of genome.
    template <class G>
    std::vector<Rule<G>> rules() const {
        return std::apply([](const R&... each) { return std::vector<Rule<G>>{rule_of<G>(each)...}; }, of);
    }
};
/// Combines rules; the block ends when the first of them holds.
template <class... R>
AnyOf<R...> any_of(R... rules) {
    return {{std::move(rules)...}};
}

} // namespace ga
