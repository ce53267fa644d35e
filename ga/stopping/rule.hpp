#pragma once

#include "ga/pareto/hypervolume.hpp"
#include "ga/pipeline/check.hpp"
#include "ga/pipeline/parameters.hpp"
#include "ga/problem/comparison.hpp"

#include <functional>

namespace ga {

/// The state of a block before each generation, for its stopping rules.
template <class G>
struct Progress {
    std::size_t generation;          ///< number of completed generations
    long asked;                      ///< evaluations requested since the block began
    double seconds;                  ///< time since the block began, in all processes of the run
    const Population<G>& population; ///< before the generation
};

/// Numbers that a rule stores from one generation to the next; checkpoints contain them.
using Numbers = std::vector<double>;

/// A stopping rule is a small struct that derives from this tag. It has words() and describe() like an
/// operator, and this member:
///
/// @code
///     template <class G> bool operator()(const Progress<G>&, Numbers& memory) const;
/// @endcode
/// It may also have
/// @code
///     void check(const CheckState&, const std::string& stage) const;   checks its needs
///     static constexpr bool sure = true;                               it certainly holds at some time
/// @endcode
struct StoppingRule {};

/// A stopping rule for one type of genome.
template <class G>
struct Rule {
    std::string text; ///< "stagnation 5"
    std::function<void(const CheckState&, const std::string&)>
        check; ///< checks the needs of the rule, if it has any; named stage
    std::function<bool(const Progress<G>&, Numbers&)> holds; ///< whether to end the block
    bool sure = false;                                       ///< it certainly holds at some time
};

/// The rule for one type of genome.
template <class G, class R>
requires std::derived_from<R, StoppingRule> Rule<G> rule_of(R rule) {
    Rule<G> made{text_of(rule), {}, rule};
    if constexpr (requires(const CheckState& known) { rule.check(known, ""); })
        made.check = [rule](const CheckState& known, const std::string& stage) { rule.check(known, stage); };
    if constexpr (requires { R::sure; })
        made.sure = R::sure;
    return made;
}

/// Whether the population is better than in all earlier generations of the block. Under one objective the
/// best individuals are compared by Deb's rules. Under several the hypervolumes of the fronts are compared.
/// Their reference is the first front's minimum minus a tenth of its range. For four objectives or more it is
/// estimated (dominated_share). Stores in `memory` the violation, the worth and the last generation that
/// improved.
template <class G>
bool improves(const Progress<G>& now, Numbers& memory) {
    if (memory.empty())
        memory = {HUGE_VAL, -HUGE_VAL, 0};
    double violation = HUGE_VAL, worth = -HUGE_VAL;
    std::vector<Point> points;
    for (const auto& individual : now.population) {
        const Fitness& fitness = individual.fitness;
        if (!fitness.known())
            return false;
        if (fitness.has_failed())
            continue;
        const double own = fitness.feasible() ? 0 : fitness.violation();
        const double merit = fitness.several() || own > 0 ? -HUGE_VAL : fitness.merit();
        if (std::pair(own, -merit) < std::pair(violation, -worth))
            violation = own, worth = merit;
        if (fitness.several() && own == 0)
            points.push_back(fitness.values());
    }
    if (!points.empty()) {
        const std::size_t m = points.front().size();
        Point ranges;
        for (std::size_t k = 0; memory.size() < 3 + m; ++k) {
            const auto [least, most] = std::minmax_element(
                points.begin(), points.end(), [k](const Point& a, const Point& b) { return a[k] < b[k]; });
            ranges.push_back(std::max((*most)[k] - (*least)[k], 1e-9));
            memory.push_back((*least)[k] - 0.1 * ranges.back());
        }
        memory.insert(memory.end(), ranges.begin(), ranges.end());
        const auto at = memory.begin() + 3;
        const Point reference(at, at + static_cast<std::ptrdiff_t>(m)),
            width(at + static_cast<std::ptrdiff_t>(m), memory.end());
        worth = m < 4 ? hypervolume(std::move(points), reference) : dominated_share(points, reference, width);
    }
    if (!(std::pair(violation, -worth) < std::pair(memory[0], -memory[1])))
        return false;
    memory[0] = violation;
    memory[1] = worth;
    memory[2] = static_cast<double>(now.generation);
    return true;
}

} // namespace ga
