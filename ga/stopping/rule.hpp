#pragma once

#include "ga/pareto/hypervolume.hpp"
#include "ga/pipeline/check.hpp"
#include "ga/pipeline/parameters.hpp"
#include "ga/problem/comparison.hpp"

#include <functional>

namespace ga {

/// What a stopping rule sees before each generation of its block.
template <class G>
struct Progress {
    std::size_t generation;          ///< how many were made
    long asked;                      ///< evaluations asked for since the block began
    double seconds;                  ///< since the block began, in all the processes that carried it
    const Population<G>& population; ///< as it is
};

/// Numbers that a rule keeps from one generation to the next; a checkpoint holds them.
using Numbers = std::vector<double>;

/// A stopping rule is a small struct deriving from this tag, with words() and describe() as an operator has,
/// and
/// @code
///     template <class G> bool operator()(const Progress<G>&, Numbers& memory) const;
/// @endcode
/// Besides, it may have
/// @code
///     void check(const CheckState&, const std::string& stage) const;   what it needs
///     static constexpr bool sure = true;                          it holds some day, whatever the stages do
/// @endcode
struct StoppingRule {};

/// A stopping rule for one type of genome.
template <class G>
struct Rule {
    std::string text; ///< "stagnation 5"
    std::function<void(const CheckState&, const std::string&)>
        check;                                               ///< what it needs, if anything; named stage
    std::function<bool(const Progress<G>&, Numbers&)> holds; ///< whether the block ends
    bool sure = false;                                       ///< it holds some day
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

/// Whether the population is better than the block's has been before, by its policy: the best of it by Deb's
/// rules, under several objectives the hypervolume of its front above the first front's minimum less a tenth
/// of its range, estimated from four objectives on (dominated_share). Keeps that in `memory`: violation,
/// worth, and the generation that was better last.
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
